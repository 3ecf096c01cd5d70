#include "workbench/experiment/experiment_folder.h"

#include "core/io/atomic_file.h"
#include "core/io/input_file.h"
#include "workbench/recording/build_identity.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>

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

/// A sidecar's values, one after the other; the first that is missing or of another type is kept.
class SidecarReader {
 public:
  SidecarReader(const ordered_json& json, const fs::path& path) : json_(json), path_(path) {}

  template <class T>
  SidecarReader& take(const char* key, T& value, const char* otherwise = "no text") {
    const auto found = json_.find(key);
    if (found == json_.end()) return wrong(std::string("it has no \"") + key + "\"");
    if (const T* held = found->template get_ptr<const T*>())
      value = *held;
    else
      wrong(std::string("its \"") + key + "\" is " + otherwise);
    return *this;
  }
  /// A whole number, written as text: JSON's numbers are not exact so far up.
  SidecarReader& take_seed(const char* key, std::uint64_t& value) {
    std::string text;
    take(key, text);
    if (!status_) return *this;
    const char* end = text.data() + text.size();
    const auto [at, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && at == end ? *this : wrong(std::string("its \"") + key + "\" is no whole number");
  }
  const Status& status() const { return status_; }

 private:
  SidecarReader& wrong(const std::string& what) {
    if (status_)
      status_ = fail("is no sidecar of an experiment: " + what, path_.string(), "use the file as it was written");
    return *this;
  }

  const ordered_json& json_;
  const fs::path& path_;
  Status status_;
};

Result<Enrolment> enrolment_of(const ordered_json& json, const fs::path& path) {
  Enrolment out;
  std::int64_t format = 0;
  SidecarReader reader(json, path);
  reader.take("format", format, "no whole number");
  if (reader.status() && format > kSidecarFormat)
    return fail("is of a newer program", path.string(), "read it with that program");
  reader.take("participant", out.mark.participant).take("simulated", out.mark.simulated);
  reader.take("pilot", out.mark.pilot, "neither true nor false").take_seed("seed", out.seed);
  reader.take("protocol", out.protocol_digest);
  if (!reader.status()) return tl::unexpected(reader.status().error());
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
  std::error_code error;
  if (!fs::exists(file, error))
    return fail("is missing: the protocol that " + rows.filename().string() + " was answered under", file.string(),
                "copy the protocol that the experiment was begun with to this name");
  Result<Protocol> protocol = read_protocol(file);
  if (!protocol) return tl::unexpected(protocol.error());
  if (protocol_digest(*protocol) != enrolment->protocol_digest)
    return fail("is not the protocol that its name says: it was changed", file.string(),
                "put the protocol back that the experiment was begun with");
  return Sidecar{*enrolment, std::move(*protocol)};
}

}  // namespace tangent::experiment
