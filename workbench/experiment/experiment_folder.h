// The data of an experiment in a folder, after BIDS (bids-specification.readthedocs.io, behavioural experiments):
//   DIR/sub-7/beh/sub-7_task-discrimination_beh.tsv    a row a trial (row_file.h)
//   DIR/sub-7/beh/sub-7_task-discrimination_beh.json   what the columns mean, and what the rows belong to
//   DIR/sub-7/beh/sub-7_task-discrimination_beh.csv    the same rows, for other programs
//   DIR/sub-7/beh/sub-7_task-discrimination_events.tsv what else happened: notes, faults, pauses (trial_events.h)
//   DIR/sub-7/beh/sub-7_task-discrimination_recordings every tick of each trial, where that is wanted
//   DIR/sub-7/sub-7_scans.tsv                          when
//   DIR/protocol-DIGEST.toml                           the protocol as it was
//   DIR/participants.tsv, dataset_description.json     and what else BIDS asks for (bids_dataset.h)
// A participant's rows belong to one protocol, seed and kind: with another one they are refused, not mixed.
#pragma once

#include "workbench/experiment/row_file.h"
#include "workbench/experiment/sidecar.h"
#include "workbench/experiment/utc_time.h"

#include <filesystem>
#include <string>

namespace tangent::experiment {

/// A participant's name is part of file names after BIDS: letters and digits, at most 40. Fails saying so.
Status check_participant(const std::string& participant);

/// Where a participant's rows are.
std::filesystem::path rows_path(const std::filesystem::path& folder, const std::string& participant,
                                const Protocol& protocol);

/// Enrols the participant, or goes on with who is enrolled: makes the folders and what BIDS wants in them, keeps the
/// protocol (its text), writes the sidecar, opens the rows. Fails where the participant was begun otherwise, saying
/// how, where rows are missing at the table's end, and where another's name differs in small and capital letters alone.
Result<RowFile> enrol(const std::filesystem::path& folder, const Protocol& protocol, const std::string& protocol_text,
                      const Enrolment& enrolment, std::int64_t now_utc_s = utc_now_s());
/// Fails where a table has fewer rows than the sidecar knows of.
Status check_not_cut(const std::filesystem::path& table, std::size_t rows, std::size_t least);

/// Beside the rows.
std::filesystem::path sidecar_path(const std::filesystem::path& rows);
std::filesystem::path events_path(const std::filesystem::path& rows);
std::filesystem::path recordings_path(const std::filesystem::path& rows);

/// What a sidecar says, and the protocol that it names.
struct Sidecar {
  Enrolment enrolment;
  Protocol protocol;
  RowCounts least;  ///< rows that were there when the program ended last
};
/// `rows`: the .tsv beside it. Fails naming what is missing or does not fit.
Result<Sidecar> read_sidecar(const std::filesystem::path& rows);

}  // namespace tangent::experiment
