#include "workbench/experiment/experiment_folder.h"

#include "core/io/atomic_file.h"
#include "workbench/experiment/bids_dataset.h"

#include <algorithm>

namespace tangent::experiment {
namespace {

namespace fs = std::filesystem;

std::string kind_name(const Protocol& protocol) { return std::string(kProtocolKinds[protocol.kind.index()]); }

fs::path protocol_path(const fs::path& folder, const std::string& digest) {
  return folder / ("protocol-" + digest + ".toml");
}

/// sub-7_task-x_beh.tsv -> sub-7_task-x and another ending.
fs::path sibling(const fs::path& rows, const std::string& ending) {
  const std::string name = rows.filename().string();
  return rows.parent_path() / (name.substr(0, name.rfind("_beh")) + ending);
}

/// How the two differ, for a person.
std::string difference(const Enrolment& begun, const Enrolment& now) {
  if (begun.protocol_digest != now.protocol_digest) return "with another protocol (" + begun.protocol_digest + ")";
  if (begun.seed != now.seed) return "with seed " + std::to_string(begun.seed);
  if (begun.mark.simulated != now.mark.simulated)
    return begun.mark.simulated == "no" ? "as a person" : "as simulated (" + begun.mark.simulated + ")";
  return begun.mark.pilot ? "as a pilot run" : "not as a pilot run";
}

/// Whether who has begun goes on as before: a sidecar that is there has to be this participant's.
Status check_sidecar(const fs::path& sidecar, const Enrolment& enrolment) {
  const auto begun = read_sidecar_head(sidecar);
  if (!begun) return tl::unexpected(begun.error());
  if (begun->enrolment == enrolment) return {};
  return fail("participant " + enrolment.mark.participant + " was begun " + difference(begun->enrolment, enrolment),
              sidecar.string(), "go on as it was begun, or take another participant or folder");
}

Status check_twin(const fs::path& folder, const std::string& participant) {
  const std::string twin = twin_by_case(folder, participant);
  if (twin.empty()) return {};
  return fail("participant " + participant + " differs from " + twin + " by small and capital letters alone",
              (folder / ("sub-" + twin)).string(),
              "write " + twin + " if it is the same person, else another name: not every disk tells them apart");
}

}  // namespace

Status check_participant(const std::string& participant) {
  const bool fits = !participant.empty() && participant.size() <= 40 &&
                    std::all_of(participant.begin(), participant.end(), [](unsigned char c) {
                      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
                    });
  if (!fits)
    return fail("\"" + participant + "\" is no name of a participant: file names after BIDS have no place for others",
                "--participant", "write letters and digits, at most 40, as P1");
  return {};
}

fs::path rows_path(const fs::path& folder, const std::string& participant, const Protocol& protocol) {
  const std::string name = "sub-" + participant;
  return folder / name / "beh" / (name + "_task-" + kind_name(protocol) + "_beh.tsv");
}

Result<RowFile> enrol(const fs::path& folder, const Protocol& protocol, const std::string& protocol_text,
                      const Enrolment& enrolment, std::int64_t now_utc_s) {
  if (Status ok = check_participant(enrolment.mark.participant); !ok) return tl::unexpected(ok.error());
  if (Status ok = check_twin(folder, enrolment.mark.participant); !ok) return tl::unexpected(ok.error());
  const fs::path rows = rows_path(folder, enrolment.mark.participant, protocol), sidecar = sidecar_path(rows);
  std::error_code error;
  fs::create_directories(rows.parent_path(), error);
  if (error)
    return fail("can't be made: " + error.message(), rows.parent_path().string(),
                "choose a folder that may be written");
  const bool begun = fs::exists(sidecar, error);
  if (begun)  // first: who is refused leaves no protocol behind
    if (Status ok = check_sidecar(sidecar, enrolment); !ok) return tl::unexpected(ok.error());
  const fs::path kept = protocol_path(folder, enrolment.protocol_digest);
  if (!fs::exists(kept, error))
    if (Status ok = write_file_atomic(kept, protocol_text); !ok) return tl::unexpected(ok.error());
  if (!begun)
    if (Status ok = write_sidecar(sidecar, protocol, enrolment); !ok) return tl::unexpected(ok.error());
  Fields columns;
  for (const ColumnMeaning& column : columns_of(protocol)) columns.emplace_back(column.name);
  auto file = RowFile::open(rows, columns, enrolment.identity());
  if (!file) return file;
  const auto head = read_sidecar_head(sidecar);
  if (!head) return tl::unexpected(head.error());
  Status ok = check_not_cut(rows, file->rows().size(), head->least().answers);
  if (ok) ok = describe_dataset(folder);
  if (ok) ok = list_participant(folder, enrolment.mark);
  if (ok) ok = list_scan(rows, enrolment.mark, now_utc_s);
  if (!ok) return tl::unexpected(ok.error());
  return file;
}

Status check_not_cut(const fs::path& table, std::size_t rows, std::size_t least) {
  if (rows >= least) return {};
  return fail(
      "was cut at its end: " + std::to_string(rows) + " of at least " + std::to_string(least) + " rows are left",
      table.string(), "put the file back as it was written");
}

fs::path sidecar_path(const fs::path& rows) { return fs::path(rows).replace_extension(".json"); }
fs::path events_path(const fs::path& rows) { return sibling(rows, "_events.tsv"); }
fs::path recordings_path(const fs::path& rows) { return sibling(rows, "_recordings"); }

Result<Sidecar> read_sidecar(const fs::path& rows) {
  if (!rows.filename().string().ends_with("_beh.tsv"))
    return fail("is no table of answers: its name does not end with _beh.tsv", rows.string(),
                "give the folder that `workbench experiment --out` was given, or a table in it");
  const auto head = read_sidecar_head(sidecar_path(rows));
  if (!head) return tl::unexpected(head.error());
  const Enrolment& enrolment = head->enrolment;
  // DIR/sub-7/beh/x.tsv: the protocol is in DIR
  const fs::path folder = fs::absolute(rows).parent_path().parent_path().parent_path();
  const fs::path file = protocol_path(folder, enrolment.protocol_digest);
  std::error_code error;
  if (!fs::exists(file, error))
    return fail("is missing: the protocol that " + rows.filename().string() + " was answered under", file.string(),
                "copy the protocol that the experiment was begun with to this name");
  Result<Protocol> protocol = read_protocol(file);
  if (!protocol) return tl::unexpected(protocol.error());
  if (protocol_digest(*protocol) != enrolment.protocol_digest)
    return fail("is not the protocol that its name says: it was changed", file.string(),
                "put the protocol back that the experiment was begun with");
  return Sidecar{enrolment, std::move(*protocol), head->least()};
}

}  // namespace tangent::experiment
