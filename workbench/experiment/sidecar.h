// The sidecar of a participant's table, sub-7_task-x_beh.json, after BIDS: what each column means, and, under
// "TangentWorkbench", what the rows belong to and every start of the program: when it began and ended, and how many
// rows there were then, so that a table that was cut at its end is told.
#pragma once

#include "workbench/experiment/protocol.h"
#include "workbench/experiment/trial_rows.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tangent::experiment {

/// What a participant's rows belong to.
struct Enrolment {
  RunMark mark;
  std::uint64_t seed = 0;
  std::string protocol_digest;
  bool operator==(const Enrolment&) const = default;
  std::string identity() const;  ///< for RowFile
};

/// Rows on the disk.
struct RowCounts {
  std::size_t answers = 0, events = 0;
  bool operator==(const RowCounts&) const = default;
};

/// One start of the program.
struct StartNote {
  std::int64_t began_utc_s = 0;
  std::optional<std::int64_t> ended_utc_s;  ///< none: it was killed
  RowCounts counts;                         ///< at its end; as at its beginning where it was killed
  bool operator==(const StartNote&) const = default;
};

struct SidecarHead {
  Enrolment enrolment;
  std::vector<StartNote> starts;  ///< oldest first; none in files of earlier programs
  RowCounts least() const;        ///< that the tables must have
};

std::span<const ColumnMeaning> columns_of(const Protocol& protocol);

/// Fails on what is no sidecar, saying why.
Result<SidecarHead> read_sidecar_head(const std::filesystem::path& sidecar);
/// Atomic, as all that follows.
Status write_sidecar(const std::filesystem::path& sidecar, const Protocol& protocol, const Enrolment& enrolment);
/// Adds a start.
Status note_start(const std::filesystem::path& sidecar, std::int64_t now_utc_s, const RowCounts& counts);
/// Ends the newest one, and adds the hashes of what was shown, by name.
Status note_end(const std::filesystem::path& sidecar, std::int64_t now_utc_s, const RowCounts& counts,
                const std::map<std::string, std::string>& hashes = {});

/// What a column means, as BIDS wants it: a JSON object of names, each with Description and Units.
std::string columns_json(std::span<const ColumnMeaning> columns);

}  // namespace tangent::experiment
