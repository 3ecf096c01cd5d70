#include "workbench/recording/exporter.h"
#include "workbench/recording/mcap_file.h"
#include "workbench/recording/recording.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace tangent {
namespace {

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
        text_ += ",\"" + column.name + "\":" + (column.is_word() ? nlohmann::json(value_).dump() : value_);
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
      const char* type = column.real != nullptr ? "number" : column.is_word() ? "string" : "integer";
      schema["properties"][column.name] = {{"type", type},
                                           {"description", column.meaning + " [" + unit_of(column.name) + "]"}};
    }
    return schema.dump();
  }

  McapFile file_;
  double origin_s_;
  std::vector<Channel> channels_;
  std::string text_, value_;
};

}  // namespace

Result<std::unique_ptr<Exporter>> mcap_exporter(const ExportTarget& target, std::vector<ExportedColumn> columns) {
  Result<McapFile> file = McapFile::create(target.to);
  if (!file) return tl::unexpected(file.error());
  return std::make_unique<McapExporter>(std::move(*file), columns, target.info.first_s);
}

}  // namespace tangent
