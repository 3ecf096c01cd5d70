#include "workbench/experiment/sidecar.h"

#include "core/base/fnv.h"
#include "core/io/atomic_file.h"
#include "core/io/input_file.h"
#include "workbench/experiment/utc_time.h"
#include "workbench/recording/build_identity.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>

namespace tangent::experiment {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::size_t kMaxSidecarBytes = std::size_t{1} << 22;
constexpr int kSidecarFormat = 2;
constexpr const char* kOwn = "TangentWorkbench";
constexpr const char* kAsWritten = "use the file as it was written";

std::string text_of_json(const ordered_json& json) {
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

void add_columns(ordered_json& json, std::span<const ColumnMeaning> columns) {
  for (const ColumnMeaning& column : columns) {
    ordered_json& entry = json[std::string(column.name)];
    entry["Description"] = column.meaning;
    if (!column.unit.empty()) entry["Units"] = column.unit;
  }
}

Status not_a_sidecar(const fs::path& path, const std::string& what) {
  return fail("is no sidecar of an experiment: " + what, path.string(), kAsWritten);
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
    if (status_) status_ = not_a_sidecar(path_, what);
    return *this;
  }

  const ordered_json& json_;
  const fs::path& path_;
  Status status_;
};

/// Where our own values are; those of format 1 stood among the columns.
const ordered_json& own_of(const ordered_json& json) {
  const auto found = json.find(kOwn);
  return found != json.end() ? *found : json;
}

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
  std::string digest = Fnv().add(out.identity()).text();
  if (json.contains("digest")) reader.take("digest", digest);
  if (!reader.status()) return tl::unexpected(reader.status().error());
  if (digest == Fnv().add(out.identity()).text()) return out;
  return fail("was changed by hand: its participant, kind, seed and protocol do not fit its digest", path.string(),
              kAsWritten);
}

std::optional<StartNote> start_of(const ordered_json& json) {
  const auto count = [&json](const char* key) -> std::optional<std::size_t> {
    const auto found = json.find(key);
    if (found == json.end() || !found->is_number_unsigned()) return std::nullopt;
    return found->get<std::size_t>();
  };
  const auto time = [&json](const char* key) -> std::optional<std::int64_t> {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? utc_of(found->get<std::string>()) : std::nullopt;
  };
  const auto began = time("began"), ended = time("ended");
  const auto answers = count("answers"), events = count("events");
  if (!began || (json.contains("ended") && !ended) || !answers || !events) return std::nullopt;
  return StartNote{*began, ended, {*answers, *events}};
}

Result<std::vector<StartNote>> starts_of(const ordered_json& own, const fs::path& path) {
  std::vector<StartNote> out;
  const auto list = own.find("starts");
  if (list == own.end()) return out;
  if (!list->is_array()) return tl::unexpected(not_a_sidecar(path, "its \"starts\" are no list").error());
  for (const ordered_json& one : *list) {
    const auto start = start_of(one);
    if (!start) return tl::unexpected(not_a_sidecar(path, "one of its \"starts\" is not as it was written").error());
    out.push_back(*start);
  }
  return out;
}

Result<ordered_json> read_json(const fs::path& path) {
  const Result<std::string> text = read_input_file(path, kMaxSidecarBytes);
  if (!text) return tl::unexpected(text.error());
  ordered_json json = ordered_json::parse(*text, nullptr, false);
  if (json.is_discarded()) return fail("is no JSON", path.string(), kAsWritten);
  return json;
}

/// Reads, lets `change` change what is our own, writes.
template <class Change>
Status change_own(const fs::path& path, const Change& change) {
  auto json = read_json(path);
  if (!json) return tl::unexpected(json.error());
  if (!json->is_object()) return fail("is no sidecar of an experiment", path.string(), kAsWritten);
  change(json->contains(kOwn) ? (*json)[kOwn] : *json);
  return write_file_atomic(path, text_of_json(*json));
}

}  // namespace

std::string Enrolment::identity() const {
  return "experiment 1|" + mark.participant + "|" + mark.simulated + "|" + (mark.pilot ? "pilot" : "") + "|" +
         std::to_string(seed) + "|" + protocol_digest;
}

RowCounts SidecarHead::least() const {
  RowCounts out;
  for (const StartNote& start : starts) {
    out.answers = std::max(out.answers, start.counts.answers);
    out.events = std::max(out.events, start.counts.events);
  }
  return out;
}

std::span<const ColumnMeaning> columns_of(const Protocol& protocol) {
  return protocol.discrimination() ? comparison_columns() : naming_columns();
}

Result<SidecarHead> read_sidecar_head(const fs::path& sidecar) {
  const auto json = read_json(sidecar);
  if (!json) return tl::unexpected(json.error());
  const ordered_json& own = own_of(*json);
  auto enrolment = enrolment_of(own, sidecar);
  if (!enrolment) return tl::unexpected(enrolment.error());
  auto starts = starts_of(own, sidecar);
  if (!starts) return tl::unexpected(starts.error());
  return SidecarHead{std::move(*enrolment), std::move(*starts)};
}

Status write_sidecar(const fs::path& sidecar, const Protocol& protocol, const Enrolment& enrolment) {
  ordered_json json{{"TaskName", kProtocolKinds[protocol.kind.index()]},
                    {"TaskDescription", protocol.name},
                    {"SoftwareName", "Tangent Workbench"},
                    {"SoftwareVersion", TANGENT_VERSION},
                    {kOwn,
                     {{"format", kSidecarFormat},
                      {"participant", enrolment.mark.participant},
                      {"simulated", enrolment.mark.simulated},
                      {"pilot", enrolment.mark.pilot},
                      {"seed", std::to_string(enrolment.seed)},
                      {"protocol", enrolment.protocol_digest},
                      {"protocol_version", protocol.version},
                      {"program", build_identity()},
                      {"preset", preset_digest(protocol.preset)},
                      {"digest", Fnv().add(enrolment.identity()).text()},
                      {"starts", ordered_json::array()}}}};
  add_columns(json, columns_of(protocol));
  json["check"]["Description"] = "checksum of this row and the one before";
  return write_file_atomic(sidecar, text_of_json(json));
}

Status note_start(const fs::path& sidecar, std::int64_t now_utc_s, const RowCounts& counts) {
  return change_own(sidecar, [&](ordered_json& own) {
    own["starts"].push_back({{"began", utc_text(now_utc_s)}, {"answers", counts.answers}, {"events", counts.events}});
  });
}

Status note_end(const fs::path& sidecar, std::int64_t now_utc_s, const RowCounts& counts,
                const std::map<std::string, std::string>& hashes) {
  return change_own(sidecar, [&](ordered_json& own) {
    ordered_json& starts = own["starts"];
    if (starts.is_array() && !starts.empty() && starts.back().is_object()) {
      starts.back()["ended"] = utc_text(now_utc_s);
      starts.back()["answers"] = counts.answers;
      starts.back()["events"] = counts.events;
    }
    ordered_json& known = own["stimuli"];
    if (!known.is_object()) known = ordered_json::object();
    for (const auto& [name, hash] : hashes) known[name] = hash;
  });
}

std::string columns_json(std::span<const ColumnMeaning> columns) {
  ordered_json json = ordered_json::object();
  add_columns(json, columns);
  return text_of_json(json);
}

}  // namespace tangent::experiment
