#include "workbench/experiment/experiment_folder.h"

#include "core/io/atomic_file.h"
#include "core/io/input_file.h"
#include "workbench/recording/build_identity.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace tangent::experiment {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::size_t kMaxSidecarBytes = std::size_t{1} << 22;
constexpr int kSidecarFormat = 1;

std::string kind_name(const Protocol& protocol) { return std::string(kProtocolKinds[protocol.kind.index()]); }

std::span<const ColumnMeaning> columns_of(const Protocol& protocol) {
  return protocol.discrimination() ? comparison_columns() : naming_columns();
}

fs::path beside(const fs::path& rows) { return fs::path(rows).replace_extension(".json"); }
fs::path protocol_path(const fs::path& folder, const std::string& digest) {
  return folder / ("protocol-" + digest + ".toml");
}

/// sub-7_task-x_beh.tsv -> sub-7_task-x and another ending.
fs::path sibling(const fs::path& rows, const std::string& ending) {
  const std::string name = rows.filename().string();
  return rows.parent_path() / (name.substr(0, name.rfind("_beh")) + ending);
}

ordered_json sidecar_json(const Protocol& protocol, const Enrolment& enrolment) {
  ordered_json json{{"TaskName", kind_name(protocol)},
                    {"TaskDescription", protocol.name},
                    {"format", kSidecarFormat},
                    {"participant", enrolment.mark.participant},
                    {"simulated", enrolment.mark.simulated},
                    {"pilot", enrolment.mark.pilot},
                    {"seed", std::to_string(enrolment.seed)},
                    {"protocol", enrolment.protocol_digest},
                    {"protocol_version", protocol.version},
                    {"SoftwareName", "Tangent Workbench"},
                    {"SoftwareVersion", TANGENT_VERSION},
                    {"program", build_identity()},
                    {"preset", preset_digest(protocol.preset)}};
  for (const ColumnMeaning& column : columns_of(protocol)) {
    ordered_json& entry = json["columns"][std::string(column.name)];
    entry["Description"] = column.meaning;
    if (!column.unit.empty()) entry["Units"] = column.unit;
  }
  json["columns"]["check"]["Description"] = "checksum of this row and the one before";
  return json;
}

Result<Enrolment> enrolment_of(const ordered_json& json, const fs::path& path) {
  Enrolment out;
  try {
    if (json.at("format").get<int>() > kSidecarFormat)
      return fail("is of a newer program", path.string(), "read it with that program");
    out.mark.participant = json.at("participant").get<std::string>();
    out.mark.simulated = json.at("simulated").get<std::string>();
    out.mark.pilot = json.at("pilot").get<bool>();
    out.seed = std::stoull(json.at("seed").get<std::string>());
    out.protocol_digest = json.at("protocol").get<std::string>();
  } catch (const std::exception& error) {
    return fail(std::string("is no sidecar of an experiment: ") + error.what(), path.string(),
                "use the file as it was written");
  }
  return out;
}

Result<Enrolment> read_enrolment(const fs::path& path) {
  const Result<std::string> text = read_input_file(path, kMaxSidecarBytes);
  if (!text) return tl::unexpected(text.error());
  const ordered_json json = ordered_json::parse(*text, nullptr, false);
  if (json.is_discarded()) return fail("is no JSON", path.string(), "use the file as it was written");
  return enrolment_of(json, path);
}

/// How the two differ, for a person.
std::string difference(const Enrolment& begun, const Enrolment& now) {
  if (begun.protocol_digest != now.protocol_digest) return "with another protocol (" + begun.protocol_digest + ")";
  if (begun.seed != now.seed) return "with seed " + std::to_string(begun.seed);
  if (begun.mark.simulated != now.mark.simulated)
    return begun.mark.simulated == "no" ? "as a person" : "as simulated (" + begun.mark.simulated + ")";
  return begun.mark.pilot ? "as a pilot run" : "not as a pilot run";
}

}  // namespace

std::string Enrolment::identity() const {
  return "experiment 1|" + mark.participant + "|" + mark.simulated + "|" + (mark.pilot ? "pilot" : "") + "|" +
         std::to_string(seed) + "|" + protocol_digest;
}

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
                      const Enrolment& enrolment) {
  if (Status ok = check_participant(enrolment.mark.participant); !ok) return tl::unexpected(ok.error());
  const fs::path rows = rows_path(folder, enrolment.mark.participant, protocol), sidecar = beside(rows);
  std::error_code error;
  fs::create_directories(rows.parent_path(), error);
  if (error)
    return fail("can't be made: " + error.message(), rows.parent_path().string(),
                "choose a folder that may be written");
  const fs::path kept = protocol_path(folder, enrolment.protocol_digest);
  if (!fs::exists(kept, error))
    if (Status ok = write_file_atomic(kept, protocol_text); !ok) return tl::unexpected(ok.error());
  if (fs::exists(sidecar, error)) {
    const Result<Enrolment> begun = read_enrolment(sidecar);
    if (!begun) return tl::unexpected(begun.error());
    if (*begun != enrolment)
      return fail("participant " + enrolment.mark.participant + " was begun " + difference(*begun, enrolment),
                  sidecar.string(), "go on as it was begun, or take another participant or folder");
  } else {
    const std::string text =
        sidecar_json(protocol, enrolment).dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
    if (Status ok = write_file_atomic(sidecar, text); !ok) return tl::unexpected(ok.error());
  }
  Fields columns;
  for (const ColumnMeaning& column : columns_of(protocol)) columns.emplace_back(column.name);
  return RowFile::open(rows, columns, enrolment.identity());
}

std::filesystem::path events_path(const fs::path& rows) { return sibling(rows, "_events.tsv"); }
std::filesystem::path recordings_path(const fs::path& rows) { return sibling(rows, "_recordings"); }

Status note_stimuli(const fs::path& rows, const std::map<std::string, std::string>& hashes) {
  const fs::path sidecar = beside(rows);
  const Result<std::string> text = read_input_file(sidecar, kMaxSidecarBytes);
  if (!text) return tl::unexpected(text.error());
  ordered_json json = ordered_json::parse(*text, nullptr, false);
  if (!json.is_object()) return fail("is no JSON", sidecar.string(), "use the file as it was written");
  ordered_json known = json.value("stimuli", ordered_json::object());
  if (!known.is_object()) known = ordered_json::object();
  for (const auto& [name, hash] : hashes) known[name] = hash;
  json["stimuli"] = std::move(known);
  return write_file_atomic(sidecar, json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

Result<Sidecar> read_sidecar(const fs::path& rows) {
  const Result<Enrolment> enrolment = read_enrolment(beside(rows));
  if (!enrolment) return tl::unexpected(enrolment.error());
  // DIR/sub-7/beh/x.tsv: the protocol is in DIR
  const fs::path folder = fs::absolute(rows).parent_path().parent_path().parent_path();
  const fs::path file = protocol_path(folder, enrolment->protocol_digest);
  Result<Protocol> protocol = read_protocol(file);
  if (!protocol) return tl::unexpected(protocol.error());
  if (protocol_digest(*protocol) != enrolment->protocol_digest)
    return fail("is not the protocol that its name says: it was changed", file.string(),
                "put the protocol back that the experiment was begun with");
  return Sidecar{*enrolment, std::move(*protocol)};
}

}  // namespace tangent::experiment
