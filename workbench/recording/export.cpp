#include "workbench/recording/export.h"

#include "core/base/text.h"
#include "core/io/ticks_file.h"
#include "workbench/recording/mcap_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

/// A column by its name; neither: the number of the tick.
struct ExportedColumn {
  std::string name;
  const RealColumn* real = nullptr;
  const WholeColumn* whole = nullptr;
};

std::vector<ExportedColumn> all_exported() {
  std::vector<ExportedColumn> found{{"tick", nullptr, nullptr}};
  for (const RealColumn& column : real_columns()) found.push_back({std::string(column.name), &column, nullptr});
  for (const auto columns : {whole_columns(), device_columns()})
    for (const WholeColumn& column : columns) found.push_back({std::string(column.name), nullptr, &column});
  return found;
}

Result<ExportedColumn> exported(const std::string& name) {
  const std::vector<ExportedColumn> all = all_exported();
  const auto found = std::find_if(all.begin(), all.end(), [&name](const auto& column) { return column.name == name; });
  if (found != all.end()) return *found;
  std::string names;
  for (const ExportedColumn& column : all) names += (names.empty() ? "" : ", ") + column.name;
  return fail("there is no channel '" + name + "'", "--channels", "choose from: " + names);
}

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> parts;
  for (std::size_t end = 0; end != std::string_view::npos; text.remove_prefix(std::min(end + 1, text.size()))) {
    end = text.find(',');
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) break;
  }
  return parts;
}

Result<std::vector<ExportedColumn>> chosen(const std::vector<std::string>& names, bool csv) {
  if (names.empty() && !csv) return all_exported();
  std::vector<std::string> wanted = names.empty() ? split(kTicksHeader) : std::vector<std::string>{"tick", "t_s"};
  for (const std::string& name : names)
    if (std::find(wanted.begin(), wanted.end(), name) == wanted.end()) wanted.push_back(name);
  std::vector<ExportedColumn> columns;
  for (const std::string& name : wanted) {
    Result<ExportedColumn> column = exported(name);
    if (!column) return tl::unexpected(column.error());
    columns.push_back(std::move(*column));
  }
  return columns;
}

/// As ticks.csv writes it; a number that is none is empty.
void append_value(std::string& text, const ExportedColumn& column, RecordedTick& tick) {
  if (column.real != nullptr) {
    const double value = column.real->at(tick);
    const bool none = !std::isfinite(value) || (column.real->of_velocity && !tick.has_velocity);
    if (!none) append_double(text, value);
  } else if (column.whole != nullptr && column.whole->word != nullptr) {
    text += column.whole->word(column.whole->get(tick));
  } else {
    text += column.whole != nullptr ? std::to_string(column.whole->get(tick)) : std::to_string(tick.record.tick.tick);
  }
}

class Exporter {
 public:
  virtual ~Exporter() = default;
  virtual Status add(RecordedTick& tick) = 0;
  virtual Status commit() = 0;
};

class CsvExporter final : public Exporter {
 public:
  CsvExporter(AtomicFile file, std::vector<ExportedColumn> columns)
      : file_(std::move(file)), columns_(std::move(columns)) {}
  Status add(RecordedTick& tick) override {
    line_.clear();
    if (first_)
      for (const ExportedColumn& column : columns_) line_ += column.name + (&column == &columns_.back() ? "\n" : ",");
    first_ = false;
    for (const ExportedColumn& column : columns_) {
      append_value(line_, column, tick);
      line_ += &column == &columns_.back() ? '\n' : ',';
    }
    return file_.write(line_);
  }
  Status commit() override { return file_.commit(); }

 private:
  AtomicFile file_;
  std::vector<ExportedColumn> columns_;
  std::string line_;
  bool first_ = true;
};

/// A topic for each of these beginnings of a column's name; the others are in the last.
constexpr std::pair<std::string_view, std::string_view> kTopics[]{
    {"finger_", "/finger"},      {"contact_", "/contact"},
    {"normal_", "/contact"},     {"penetration", "/contact"},
    {"triangle", "/contact"},    {"status", "/contact"},
    {"u", "/contact"},           {"v", "/contact"},
    {"force_x", "/force"},       {"force_y", "/force"},
    {"force_z", "/force"},       {"decided_force", "/force"},
    {"command_force", "/force"}, {"device_force", "/force"},
    {"way_out", "/force"},       {"cld", "/display"},
    {"decided_cld", "/display"}, {"command_cld", "/display"},
    {"device_cld", "/display"},  {"error", "/solver"},
    {"iterations", "/solver"},   {"event", "/solver"},
    {"solve_ns", "/solver"},     {"preset_id", "/solver"},
    {"scene_id", "/solver"},     {"hand_x", "/hand"},
    {"hand_y", "/hand"},         {"hand_z", "/hand"},
    {"tick_ns", "/timing"},      {"period", "/timing"},
    {"lateness", "/timing"},     {"latency", "/timing"},
    {"missed", "/timing"},       {"", "/devices"}};

std::string topic_of(const std::string& column) {
  for (const auto& [beginning, topic] : kTopics) {
    const bool whole_name = beginning.size() == 1;  // u, v
    if (whole_name ? column == beginning : column.starts_with(beginning)) return std::string(topic);
  }
  return "/devices";
}

class McapExporter final : public Exporter {
 public:
  McapExporter(McapFile file, const std::vector<ExportedColumn>& columns, double first_s)
      : file_(std::move(file)), origin_s_(std::min(0.0, first_s)) {
    std::map<std::string, std::vector<ExportedColumn>> by_topic;
    for (const ExportedColumn& column : columns)
      if (column.name != "tick" && column.name != "t_s") by_topic[topic_of(column.name)].push_back(column);
    for (auto& [topic, members] : by_topic) {
      const std::uint16_t number = file_.add_channel(topic, "tangent" + topic, schema_of(members));
      channels_.push_back({number, std::move(members)});
    }
  }
  Status add(RecordedTick& tick) override {
    const double since_s = tick.record.tick.input.t_s - origin_s_;
    const auto time_ns =
        since_s > 0.0 && since_s < 1e9 ? static_cast<std::uint64_t>(std::llround(since_s * 1e9)) : std::uint64_t{0};
    for (const Channel& channel : channels_) {
      text_ = "{\"tick\":" + std::to_string(tick.record.tick.tick);
      for (const ExportedColumn& column : channel.columns) {
        value_.clear();
        append_value(value_, column, tick);
        if (value_.empty()) value_ = "null";
        const bool word = column.whole != nullptr && column.whole->word != nullptr;
        text_ += ",\"" + column.name + "\":" + (word ? nlohmann::json(value_).dump() : value_);
      }
      if (Status ok = file_.write(channel.number, time_ns, text_ + "}"); !ok) return ok;
    }
    return {};
  }
  Status commit() override { return file_.commit(); }

 private:
  struct Channel {
    std::uint16_t number = 0;
    std::vector<ExportedColumn> columns;
  };
  static std::string schema_of(const std::vector<ExportedColumn>& columns) {
    nlohmann::ordered_json schema{{"type", "object"}, {"properties", {{"tick", {{"type", "integer"}}}}}};
    for (const ExportedColumn& column : columns) {
      const bool word = column.whole != nullptr && column.whole->word != nullptr;
      const auto meaning = std::string(column.real != nullptr ? column.real->meaning : column.whole->meaning);
      const char* type = column.real != nullptr ? "number" : word ? "string" : "integer";
      schema["properties"][column.name] = {{"type", type},
                                           {"description", meaning + " [" + unit_of(column.name) + "]"}};
    }
    return schema.dump();
  }

  McapFile file_;
  double origin_s_;
  std::vector<Channel> channels_;
  std::string text_, value_;
};

Status check_ending(const std::filesystem::path& to) {
  const std::string ending = to.extension().string();
  if (ending == ".csv" || ending == ".mcap") return {};
  if (ending == ".mat")
    return fail("MATLAB's own files are not written", to.string(), "end the name in .csv, which readtable reads");
  return fail("'" + ending + "' is no format that is exported", to.string(), "end the name in .csv or .mcap");
}

Result<std::unique_ptr<Exporter>> exporter_for(const std::filesystem::path& to, const ExportOptions& options,
                                               double first_s) {
  const std::string ending = to.extension().string();
  if (Status ok = check_ending(to); !ok) return tl::unexpected(ok.error());
  Result<std::vector<ExportedColumn>> columns = chosen(options.channels, ending == ".csv");
  if (!columns) return tl::unexpected(columns.error());
  if (ending == ".csv") {
    Result<AtomicFile> file = AtomicFile::create(to);
    if (!file) return tl::unexpected(file.error());
    return std::make_unique<CsvExporter>(std::move(*file), std::move(*columns));
  }
  Result<McapFile> file = McapFile::create(to);
  if (!file) return tl::unexpected(file.error());
  return std::make_unique<McapExporter>(std::move(*file), *columns, first_s);
}

}  // namespace

Status check_export(const std::filesystem::path& to, const ExportOptions& options) {
  if (Status ok = check_ending(to); !ok) return ok;
  const auto columns = chosen(options.channels, to.extension() == ".csv");
  return columns ? Status() : tl::unexpected(columns.error());
}

Result<std::uint64_t> export_ticks(const std::filesystem::path& from, const std::filesystem::path& to,
                                   const ExportOptions& options) {
  Result<Recording> recording = Recording::open(from);
  if (!recording) return tl::unexpected(recording.error());
  const RecordingInfo& info = recording->info();
  Result<std::unique_ptr<Exporter>> exporter = exporter_for(to, options, info.first_s);
  if (!exporter) return tl::unexpected(exporter.error());
  const auto tick_at = [&](const std::optional<double>& t_s, std::uint64_t otherwise) -> Result<std::uint64_t> {
    return t_s ? recording->tick_at(*t_s) : Result<std::uint64_t>(otherwise);
  };
  const Result<std::uint64_t> first = tick_at(options.from_s, info.first_tick);
  if (!first) return first;
  Result<TickReader> ticks = recording->ticks(*first, info.last_tick);
  if (!ticks) return tl::unexpected(ticks.error());
  std::uint64_t count = 0;
  for (RecordedTick tick;; ++count) {
    if (options.cancelled()) return fail("was interrupted", to.string(), "nothing is left of it");
    const Result<bool> any = ticks->next(tick);
    if (!any) return tl::unexpected(any.error());
    if (!*any || (options.to_s && tick.record.tick.input.t_s > *options.to_s)) break;
    if (Status ok = (*exporter)->add(tick); !ok) return tl::unexpected(ok.error());
  }
  if (count == 0) return fail("has no tick between these times", from.string(), "choose others with --from and --to");
  if (Status ok = (*exporter)->commit(); !ok) return tl::unexpected(ok.error());
  return count;
}

}  // namespace tangent
