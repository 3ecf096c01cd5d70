// A protocol from its file.
#include "workbench/experiment/protocol.h"

#include "core/io/input_file.h"
#include "core/io/preset_values.h"
#include "core/io/rendering_condition.h"
#include "core/io/toml_file.h"
#include "core/io/toml_table.h"
#include "core/io/toml_text.h"
#include "core/lab/objects/generate.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace tangent::experiment {
namespace {

constexpr std::size_t kMaxProtocolBytes = std::size_t{1} << 20;
constexpr std::array<std::string_view, 2> kPlacementNames{"tangent", "inscribed"};  // order of ArcPlacement
constexpr std::array<std::string_view, 2> kParityNames{"even", "odd"};
constexpr double kMostSegments = 100000.0;

class ProtocolReader {
 public:
  ProtocolReader(const toml::table& root, std::string file) : root_(root), file_(std::move(file)) {}

  Result<Protocol> read() {
    if (Status ok = read_head(); !ok) return tl::unexpected(ok.error());
    if (Status ok = read_preset(); !ok) return tl::unexpected(ok.error());
    if (Status ok = read_sound(); !ok) return tl::unexpected(ok.error());
    const Status ok = protocol_.discrimination() ? read_discrimination() : read_identification();
    if (!ok) return tl::unexpected(ok.error());
    for (const auto& [key, node] : root_)
      if (std::find(known_.begin(), known_.end(), key.str()) == known_.end())
        return fail(
            "unknown table", file_ + ":" + std::to_string(key.source().begin.line) + " " + std::string(key.str()),
            "allowed for this kind: " + choices_text(std::vector<std::string_view>(known_.begin(), known_.end())));
    return std::move(protocol_);
  }

 private:
  std::string where(const toml::node& node, const std::string& what) const {
    return file_ + ":" + std::to_string(node.source().begin.line) + " " + what;
  }
  /// An empty one where it is missing, or no table: finish() says so.
  const toml::table& table(std::string_view name) {
    static const toml::table kEmpty;
    known_.emplace_back(name);
    const toml::node* found = root_.get(name);
    if (found == nullptr) return kEmpty;
    if (const toml::table* table = found->as_table()) return *table;
    if (status_)
      status_ = fail("is " + std::string(type_name(*found)) + ", and no table", where(*found, std::string(name)),
                     "write [" + std::string(name) + "] on a line of its own, its keys below it");
    return kEmpty;
  }
  TomlTable reader(std::string_view name) { return {table(name), file_, "[" + std::string(name) + "]"}; }
  /// The first thing that was wrong with the tables so far, or with this one's keys.
  Status finish(TomlTable& table) const { return status_ ? table.finish() : status_; }

  Status read_head() {
    bool second = false;
    TomlTable head = reader("protocol");
    head.required("kind").choice("kind", kProtocolKinds, [&](std::size_t i) { second = i == 1; });
    head.required("name").text("name", protocol_.name).whole("version", protocol_.version, 1, 1'000'000);
    if (second) protocol_.kind = Identification{};
    return finish(head);
  }

  /// Keys of a preset in quotes, as in a sweep's plan: "finger.radius_m" = 0.02.
  Status read_preset() {
    const toml::table& preset = table("preset");
    if (!status_) return status_;
    for (const auto& [key, node] : preset) {
      const std::string name(key.str());
      const std::string where = file_ + ":" + std::to_string(key.source().begin.line) + " [preset] " + name;
      const PresetKey* row = find_preset_key(name);
      if (row == nullptr) return fail("unknown key", where, "write a preset's key in quotes, as \"finger.radius_m\"");
      const toml::table inner{{std::string(row->key), node}};
      const std::string place = file_ + ":" + std::to_string(key.source().begin.line) + " [preset]";
      if (Status ok = read_preset_value(row->table, inner.begin()->first, node, place, protocol_.preset); !ok)
        return ok;
    }
    return {};
  }

  Status read_sound() {
    TomlTable sound = reader("sound");
    sound.number("noise_db", protocol_.sound.noise_db, kQuietestSound_db, kLoudestNoise_db);
    sound.number("cue_db", protocol_.sound.cue_db, kQuietestSound_db, kLoudestCue_db);
    return finish(sound);
  }

  // --- Which of two is smooth ---

  Status read_discrimination() {
    auto& d = std::get<Discrimination>(protocol_.kind);
    TomlTable arc = reader("arc");
    arc.number("radius_m", d.radius_m, 1e-3, 10.0).number("angle_rad", d.angle_rad, 0.01, 3.0);
    arc.choice("placement", kPlacementNames, [&](std::size_t i) { d.placement = static_cast<ArcPlacement>(i); });
    if (Status ok = finish(arc); !ok) return ok;
    StaircaseRule common;
    const int least = d.placement == ArcPlacement::tangent ? 3 : 2;  // of ArcStimulus
    common.fewest = least;
    if (Status ok = read_staircase(common, least); !ok) return ok;
    return read_conditions(common, d.conditions);
  }

  Status read_staircase(StaircaseRule& rule, int least) {
    TomlTable t = reader("staircase");
    t.whole("reversals", rule.reversals, 1, 1000).whole("large_reversals", rule.large_reversals, 0, 1000);
    t.whole("averaged", rule.averaged, 1, 1000).whole("down", rule.down, 1, 10);
    t.choice("scale", kStepScaleNames, [&](std::size_t i) { rule.scale = static_cast<StepScale>(i); });
    t.number("fewest", rule.fewest, 2.0, kMostSegments).number("most", rule.most, 2.0, kMostSegments);
    t.whole("most_trials", rule.most_trials, 1, 100000);
    if (Status ok = finish(t); !ok) return ok;
    if (rule.averaged > rule.reversals) return fail("averages more reversals than there are", t.where("averaged"));
    if (std::lround(rule.fewest) < least)
      return fail("would show " + std::to_string(std::lround(rule.fewest)) + " segments, which make no tangent arc",
                  t.where("fewest"), "write 3 or more, or choose inscribed ones: arc.placement");
    if (rule.fewest >= rule.most) return fail("is not below most", t.where("fewest"), "write fewer segments");
    return {};
  }

  Status read_conditions(const StaircaseRule& common, std::vector<ComparisonCondition>& out) {
    known_.emplace_back("conditions");
    const toml::node* found = root_.get("conditions");
    if (found != nullptr && !found->is_array())
      return fail("is " + std::string(type_name(*found)) + ", and no list of tables", where(*found, "conditions"),
                  "write [[conditions]] above each");
    const toml::array* list = root_["conditions"].as_array();
    if (list == nullptr || list->empty())
      return fail("has no conditions", file_ + " [[conditions]]", "name one at least");
    for (const toml::node& node : *list) {
      if (!node.is_table()) return fail("is no table", where(node, "conditions"), "write [[conditions]] above each");
      ComparisonCondition condition{{}, common};
      TomlTable t(*node.as_table(), file_, "[[conditions]]");
      t.required("name").text("name", condition.name);
      StaircaseRule& rule = condition.staircase;
      const bool ratio = rule.scale == StepScale::ratio;
      t.number("start", rule.start, rule.fewest, rule.most);
      t.number("large_step", rule.large_step, ratio ? 1.001 : 1.0, ratio ? 100.0 : kMostSegments);
      t.number("small_step", rule.small_step, ratio ? 1.001 : 1.0, ratio ? 100.0 : kMostSegments);
      if (!ratio) t.required("large_step").required("small_step");
      if (Status ok = t.finish(); !ok) return ok;
      if (std::find(kArcConditionNames.begin(), kArcConditionNames.end(), condition.name) == kArcConditionNames.end())
        return fail("is no rendering condition of arcs", t.where("name"),
                    "allowed: " + choices_text(kArcConditionNames));
      for (const ComparisonCondition& other : out)
        if (other.name == condition.name) return fail("is there twice", t.where("name"), "name each condition once");
      out.push_back(std::move(condition));
    }
    return {};
  }

  // --- Which object is it ---

  Status read_identification() {
    auto& d = std::get<Identification>(protocol_.kind);
    TomlTable objects = reader("objects");
    objects.required("names").texts("names", d.objects).texts("both_ways", d.both_ways).text("practice", d.practice);
    objects.number("rounding_m", d.rounding_m, 0.0, 0.01).number("facet_deg", d.facet_deg, 0.1, 30.0);
    if (Status ok = finish(objects); !ok) return ok;
    TomlTable runs = reader("runs");
    runs.whole("sessions", d.sessions, 1, 100).whole("blocks", d.blocks, 1, 100).whole("runs", d.runs, 1, 100);
    runs.number("hours_between", d.hours_between_sessions, 0.0, 8760.0);
    runs.choice("tactile_first", kParityNames, [&](std::size_t i) { d.tactile_first_even = i == 0; });
    if (Status ok = finish(runs); !ok) return ok;
    TomlTable start = reader("start");
    start.triple(
        "place_m",
        [&](double x, double y, double z) {
          d.start_m = {x, y, z};
        },
        -1.0, 1.0);
    start.number("radius_m", d.start_radius_m, 1e-4, 0.1).number("hold_s", d.hold_s, 0.0, 60.0);
    start.number("guide_n_per_m", d.guide_n_per_m, 0.0, 200.0).number("guide_limit_n", d.guide_limit_n, 0.0, 3.0);
    if (Status ok = finish(start); !ok) return ok;
    return check_objects(d, objects, runs);
  }

  static Status check_objects(const Identification& d, const TomlTable& objects, const TomlTable& runs) {
    if (d.objects.empty() || d.objects.size() > 9)
      return fail("has " + std::to_string(d.objects.size()) + " objects", objects.where("names"),
                  "name 1 to 9: each has a key");
    const auto& made = generator_names();
    for (const std::string& name : d.objects)
      if (std::find(made.begin(), made.end(), name) == made.end())
        return fail("there is no object \"" + name + "\"", objects.where("names"),
                    "allowed: " + choices_text(std::vector<std::string_view>(made.begin(), made.end())));
    if (std::set<std::string>(d.objects.begin(), d.objects.end()).size() != d.objects.size())
      return fail("names an object twice", objects.where("names"), "name each once: answers have to differ");
    for (const std::string& name : d.both_ways)
      if (name != "cone" && name != "tetrahedron")
        return fail("\"" + name + "\" looks the same both ways", objects.where("both_ways"),
                    "allowed: cone, tetrahedron");
    if (!d.practice.empty() && std::find(made.begin(), made.end(), d.practice) == made.end())
      return fail("there is no object \"" + d.practice + "\"", objects.where("practice"));
    if (!d.both_ways.empty() && d.runs % 2 != 0)
      return fail("can't show both ways equally often in " + std::to_string(d.runs) + " runs of a block",
                  runs.where("runs"), "write an even number, or leave objects.both_ways out");
    if (d.blocks % 2 != 0)
      return fail("can't give half of " + std::to_string(d.blocks) + " blocks tactile feedback", runs.where("blocks"),
                  "write an even number");
    return {};
  }

  const toml::table& root_;
  std::string file_;
  Protocol protocol_;
  std::vector<std::string> known_;
  Status status_;
};

}  // namespace

Result<Protocol> parse_protocol(std::string_view text, const std::filesystem::path& file) {
  const Result<toml::table> root = parse_toml(text, file.string(), "mend the protocol");
  if (!root) return tl::unexpected(root.error());
  return ProtocolReader(*root, file.string()).read();
}

Result<Protocol> read_protocol(const std::filesystem::path& file) {
  const Result<std::string> text = read_input_file(file, kMaxProtocolBytes);
  if (!text) return tl::unexpected(text.error());
  return parse_protocol(*text, file);
}

}  // namespace tangent::experiment
