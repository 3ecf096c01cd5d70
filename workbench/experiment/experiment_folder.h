// The data of an experiment in a folder, after BIDS (bids-specification.readthedocs.io, behavioural experiments):
//   DIR/sub-7/beh/sub-7_task-discrimination_beh.tsv    a row a trial (row_file.h)
//   DIR/sub-7/beh/sub-7_task-discrimination_beh.json   what the columns mean, and what the rows belong to
//   DIR/sub-7/beh/sub-7_task-discrimination_beh.csv    the same rows, for other programs
//   DIR/sub-7/beh/sub-7_task-discrimination_events.tsv what else happened: notes, faults, pauses (trial_events.h)
//   DIR/sub-7/beh/sub-7_task-discrimination_recordings every tick of each trial, where that is wanted
//   DIR/protocol-DIGEST.toml                           the protocol as it was
// A participant's rows belong to one protocol, seed and kind: with another one they are refused, not mixed.
#pragma once

#include "workbench/experiment/trial_rows.h"

#include <filesystem>
#include <map>
#include <string>

namespace tangent::experiment {

/// What a participant's rows belong to.
struct Enrolment {
  RunMark mark;
  std::uint64_t seed = 0;
  std::string protocol_digest;
  bool operator==(const Enrolment&) const = default;
  std::string identity() const;  ///< for RowFile
};

/// A participant's name is part of file names after BIDS: letters and digits, at most 40. Fails saying so.
Status check_participant(const std::string& participant);

/// Where a participant's rows are.
std::filesystem::path rows_path(const std::filesystem::path& folder, const std::string& participant,
                                const Protocol& protocol);

/// Enrols the participant, or goes on with who is enrolled: makes the folders, keeps the protocol (its text), writes
/// the sidecar, opens the rows. Fails where the participant was begun otherwise, saying how.
Result<RowFile> enrol(const std::filesystem::path& folder, const Protocol& protocol, const std::string& protocol_text,
                      const Enrolment& enrolment);

/// Beside the rows.
std::filesystem::path events_path(const std::filesystem::path& rows);
std::filesystem::path recordings_path(const std::filesystem::path& rows);
/// Adds the hashes of what was shown, by name, to the sidecar. Atomic.
Status note_stimuli(const std::filesystem::path& rows, const std::map<std::string, std::string>& hashes);

/// What a sidecar says, and the protocol that it names.
struct Sidecar {
  Enrolment enrolment;
  Protocol protocol;
};
/// `rows`: the .tsv beside it. Fails naming what is missing or does not fit.
Result<Sidecar> read_sidecar(const std::filesystem::path& rows);

}  // namespace tangent::experiment
