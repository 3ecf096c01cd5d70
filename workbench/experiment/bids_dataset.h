// What makes a folder of answers a dataset after BIDS (bids-specification.readthedocs.io): its description, a README,
// who took part, and when. Files that are there are kept, and so are columns that a lab adds to participants.tsv.
#pragma once

#include "workbench/experiment/sidecar.h"

#include <filesystem>
#include <string>

namespace tangent::experiment {

/// dataset_description.json, README, .bidsignore (our protocols, CSV copies and recordings are no part of BIDS) and
/// participants.json, each where it is missing.
Status describe_dataset(const std::filesystem::path& folder);
/// A line of participants.tsv, unless it is there. Several programs may do so at once.
Status list_participant(const std::filesystem::path& folder, const RunMark& mark);
/// A line of sub-7/sub-7_scans.tsv, with the date, unless it is there.
Status list_scan(const std::filesystem::path& rows, const RunMark& mark, std::int64_t began_utc_s);

/// Another participant of the folder whose name differs by small and capital letters alone: on disks that do not tell
/// these apart both would be one. Empty: there is none.
std::string twin_by_case(const std::filesystem::path& folder, const std::string& participant);

}  // namespace tangent::experiment
