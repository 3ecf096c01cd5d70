// A plan as TOML, both ways.
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/io/csv_table.h"
#include "core/io/input_file.h"
#include "core/io/preset_file.h"
#include "core/io/toml_file.h"
#include "workbench/session/file_units.h"
#include "workbench/sweep/plan.h"

#include <algorithm>
#include <functional>

namespace tangent::sweep {
namespace {

constexpr std::size_t kMaxPlanBytes = std::size_t{1} << 22;
constexpr std::array<std::string_view, 3> kNormalNames{"auto", "file", "computed"};  // order of NormalSource
constexpr std::array<std::string_view, 2> kScaleNames{"linear", "log"};

class PlanReader {
 public:
  explicit PlanReader(const std::filesystem::path& file) : file_(file) {}

  Result<Plan> read(const toml::table& root) {
    for (const auto& [key, node] : root) {
      const Status ok = key == "plan"      ? read_keys(key, node)
                        : key == "ranges"  ? read_ranges(key, node)
                        : key == "fingers" ? read_fingers(key, node)
                                           : unknown(key, "plan, ranges or fingers");
      if (!ok) return tl::unexpected(ok.error());
    }
    if (plan_.methods.empty()) plan_.methods.push_back(plan_.base.solver.method);
    if (Status ok = finish_fingers(); !ok) return tl::unexpected(ok.error());
    if (Status ok = check_plan(plan_); !ok) {
      Error error = ok.error();
      error.where = file_.string() + " " + error.where;
      return tl::unexpected(error);
    }
    return std::move(plan_);
  }

 private:
  using Row = std::pair<std::string_view, std::function<Status(const toml::key&, const toml::node&)>>;

  std::string where(const toml::key& key) const {
    return file_.string() + ":" + std::to_string(key.source().begin.line) + " " + std::string(key.str());
  }
  Status unknown(const toml::key& key, const std::string& allowed) const {
    return fail("unknown key", where(key), "allowed: " + allowed);
  }
  Status wrong(const toml::key& key, const std::string& wanted) const {
    return fail("is not " + wanted, where(key), "write " + wanted);
  }

  Status texts(const toml::key& key, const toml::node& node, const std::function<Status(std::string)>& add) const {
    const toml::array* list = node.as_array();
    if (list == nullptr) return wrong(key, "a list of names");
    if (list->empty()) return fail("is empty", where(key), "list a name at least");
    for (const toml::node& item : *list) {
      if (!item.is_string()) return wrong(key, "a list of names");
      if (Status ok = add(item.as_string()->get()); !ok) return ok;
    }
    return {};
  }
  Status choice(const toml::key& key, const toml::node& node, std::span<const std::string_view> names,
                const std::function<void(std::size_t)>& set) const {
    const auto text = node.value_exact<std::string>();
    const auto at = text ? std::find(names.begin(), names.end(), *text) : names.end();
    if (at == names.end()) return wrong(key, "one of: " + choices_text(names));
    set(static_cast<std::size_t>(at - names.begin()));
    return {};
  }
  Status number(const toml::key& key, const toml::node& node, double least, double most,
                const std::function<void(double)>& set) const {
    const auto value = node.value<double>();
    if (!node.is_number() || !(*value >= least && *value <= most))
      return wrong(key, "a number, " + range_text(least, most, ""));
    set(*value);
    return {};
  }
  Status whole(const toml::key& key, const toml::node& node, std::int64_t least, std::uint64_t most,
               const std::function<void(std::uint64_t)>& set) const {
    const auto value = node.value_exact<std::int64_t>();
    if (!value || *value < least || static_cast<std::uint64_t>(*value) > most)
      return wrong(key, "a whole number, " + std::to_string(least) + " to " + std::to_string(most));
    set(static_cast<std::uint64_t>(*value));
    return {};
  }

  /// As the plan names it; relative to the plan's folder.
  std::filesystem::path beside(const std::string& name) const {
    const std::filesystem::path path(name);
    return path.is_absolute() ? path : file_.parent_path() / path;
  }

  std::vector<Row> reading_rows() {
    using K = const toml::key&;
    using N = const toml::node&;
    return {
        {"unit",
         [this](K k, N n) {
           return choice(k, n, kFileUnitNames, [&](std::size_t i) { plan_.metres_per_unit = kFileUnits[i].metres; });
         }},
        {"fit_mm",
         [this](K k, N n) {
           return number(k, n, 1e-3, 1e9, [&](double mm) { plan_.reading.fit_m = mm * kMillimetre; });
         }},
        {"normals",
         [this](K k, N n) {
           return choice(k, n, kNormalNames,
                         [&](std::size_t i) { plan_.reading.normals = static_cast<NormalSource>(i); });
         }},
        {"crease_deg",
         [this](K k, N n) {
           return number(k, n, 0.0, 180.0, [&](double deg) { plan_.reading.crease_rad = deg * kDegree; });
         }},
        {"turn_over",
         [this](K k, N n) {
           const auto value = n.value_exact<bool>();
           if (!value) return wrong(k, "true or false");
           plan_.reading.turn_over = *value;
           return Status{};
         }},
    };
  }

  std::vector<Row> rows() {
    using K = const toml::key&;
    using N = const toml::node&;
    std::vector<Row> rows = reading_rows();
    const std::vector<Row> others{
        {"meshes",
         [this](K k, N n) {
           return texts(k, n, [&](const std::string& name) { return plan_.meshes.push_back(beside(name)), Status{}; });
         }},
        {"poses",
         [this](K k, N n) {
           return texts(k, n, [&](const std::string& name) {
             return plan_.poses.push_back(is_made(name) ? name : beside(name).string()), Status{};
           });
         }},
        {"methods",
         [this](K k, N n) {
           return texts(k, n, [&](const std::string& name) -> Status {
             const auto at = std::find(kMethodNames.begin(), kMethodNames.end(), name);
             if (at == kMethodNames.end()) return wrong(k, "a list of: " + choices_text(kMethodNames));
             plan_.methods.push_back(static_cast<Method>(at - kMethodNames.begin()));
             return {};
           });
         }},
        {"preset",
         [this](K k, N n) -> Status {
           const auto name = n.value_exact<std::string>();
           if (!name) return wrong(k, "the name of a preset file");
           const Result<PresetFile> preset = read_preset(beside(*name));
           if (!preset) return tl::unexpected(preset.error());
           plan_.base = preset->preset;
           return {};
         }},
        {"sampling",
         [this](K k, N n) {
           return choice(k, n, kSamplingNames, [&](std::size_t i) { plan_.sampling = static_cast<Sampling>(i); });
         }},
        {"samples", [this](K k, N n) { return whole(k, n, 1, 1u << 31, [&](std::uint64_t v) { plan_.samples = v; }); }},
        {"seed", [this](K k, N n) { return whole(k, n, 0, 1ull << 62, [&](std::uint64_t v) { plan_.seed = v; }); }},
        {"ticks", [this](K k, N n) { return whole(k, n, 1, 1ull << 40, [&](std::uint64_t v) { plan_.ticks = v; }); }},
        {"base", [this](K k, N n) { return read_base(k, n); }},
    };
    rows.insert(rows.end(), others.begin(), others.end());
    return rows;
  }

  Status read_keys(const toml::key& key, const toml::node& node) {
    const toml::table* table = node.as_table();
    if (table == nullptr) return wrong(key, "the table [plan]");
    const std::vector<Row> known = rows();
    for (const auto& [inner, value] : *table) {
      const auto row = std::find_if(known.begin(), known.end(), [&](const Row& r) { return r.first == inner.str(); });
      if (row == known.end()) {
        std::vector<std::string_view> names;
        for (const Row& r : known) names.push_back(r.first);
        return unknown(inner, choices_text(names));
      }
      if (Status ok = row->second(inner, value); !ok) return ok;
    }
    return {};
  }

  /// The base preset's values one by one, as format_plan writes them: { "solver.tolerance_m" = 1e-6 }.
  Status read_base(const toml::key& key, const toml::node& node) {
    const toml::table* table = node.as_table();
    if (table == nullptr) return wrong(key, "a table of preset keys");
    for (const auto& [name, value] : *table) {
      const Result<std::pair<const PresetKey*, double>> read = preset_value(name, name.str(), value);
      if (!read) return tl::unexpected(read.error());
      read->first->set(plan_.base, read->second);
    }
    return {};
  }

  Result<std::pair<const PresetKey*, double>> preset_value(const toml::key& at, std::string_view name,
                                                           const toml::node& node) const {
    const PresetKey* key = find_preset_key(name);
    if (key == nullptr)
      return fail("unknown key", where(at), "write a preset's key in quotes, as \"solver.gain_overall\"");
    const Result<double> value = value_of(*key, at, node);
    if (!value) return tl::unexpected(value.error());
    return std::pair{key, *value};
  }

  Result<double> value_of(const PresetKey& key, const toml::key& at, const toml::node& node) const {
    if (key.kind == KeyKind::choice) {
      const auto text = node.value_exact<std::string>();
      const int i = text ? key.choice_index(*text) : -1;
      if (i < 0) return fail("is none of its choices", where(at), "allowed: " + key.allowed());
      return static_cast<double>(i);
    }
    const auto value = node.value<double>();
    if (!node.is_number() || !key.allows(*value))
      return fail("is no value that it takes", where(at), "allowed: " + key.allowed());
    return *value;
  }

  Status read_ranges(const toml::key& key, const toml::node& node) {
    const toml::table* table = node.as_table();
    if (table == nullptr) return wrong(key, "the table [ranges]");
    for (const auto& [name, value] : *table) {
      Range range;
      range.key = find_preset_key(name.str());
      if (range.key == nullptr) return unknown(name, "the keys of a preset, in quotes, as \"solver.gain_curvature_m\"");
      const Status ok = value.is_array()   ? read_list(name, *value.as_array(), range)
                        : value.is_table() ? read_span(name, *value.as_table(), range)
                                           : wrong(name, "a list of values, or { from = ..., to = ..., count = ... }");
      if (!ok) return ok;
      plan_.ranges.push_back(std::move(range));
    }
    return {};
  }

  Status read_list(const toml::key& name, const toml::array& list, Range& range) const {
    if (list.empty()) return fail("is empty", where(name), "list a value at least");
    for (const toml::node& item : list) {
      const Result<double> value = value_of(*range.key, name, item);
      if (!value) return tl::unexpected(value.error());
      range.values.push_back(*value);
    }
    return {};
  }

  Status read_span(const toml::key& name, const toml::table& table, Range& range) const {
    if (range.key->kind == KeyKind::choice) return wrong(name, "a list of: " + range.key->allowed());
    bool from = false, to = false;
    range.logarithmic = range.key->logarithmic;
    for (const auto& [key, value] : table) {
      Status ok;
      if (key == "from" || key == "to") {
        const Result<double> number = value_of(*range.key, key, value);
        if (!number) return tl::unexpected(number.error());
        (key == "from" ? range.from : range.to) = *number;
        (key == "from" ? from : to) = true;
      } else if (key == "count") {
        ok = whole(key, value, 2, 1u << 24, [&](std::uint64_t v) { range.count = v; });
      } else if (key == "scale") {
        ok = choice(key, value, kScaleNames, [&](std::size_t i) { range.logarithmic = i == 1; });
      } else {
        ok = unknown(key, "from, to, count or scale");
      }
      if (!ok) return ok;
    }
    if (!from || !to) return fail("lacks an end", where(name), "write from and to");
    if (range.logarithmic && range.from <= 0.0 && !table.contains("scale")) range.logarithmic = false;
    return {};
  }

  Status read_fingers(const toml::key& key, const toml::node& node) {
    const toml::array* list = node.as_array();
    if (list == nullptr) return wrong(key, "tables [[fingers]]");
    fingers_ = list;
    return {};
  }

  /// After the base preset is known: what a finger leaves out is the preset's.
  Status finish_fingers() {
    if (fingers_ == nullptr) {
      plan_.fingers.push_back(plan_.base.finger);
      return {};
    }
    for (const toml::node& node : *fingers_) {
      const toml::table* table = node.as_table();
      if (table == nullptr) return fail("is no table", file_.string() + " fingers", "write [[fingers]]");
      Preset preset = plan_.base;
      for (const auto& [name, value] : *table) {
        const auto read = preset_value(name, "finger." + std::string(name.str()), value);
        if (!read) return tl::unexpected(read.error());
        read->first->set(preset, read->second);
      }
      plan_.fingers.push_back(preset.finger);
    }
    return {};
  }

  std::filesystem::path file_;
  Plan plan_;
  const toml::array* fingers_ = nullptr;
};

std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      constexpr std::string_view kHex = "0123456789ABCDEF";
      out += "\\u00";
      out += kHex[static_cast<unsigned char>(c) >> 4];
      out += kHex[static_cast<unsigned char>(c) & 15];
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string number_text(double value) {
  std::string out;
  append_double(out, value);
  return out;
}

/// Quoted where it is a choice, so that it reads back.
std::string value_text(const PresetKey& key, double value) {
  return key.kind == KeyKind::choice ? in_quotes(key.value_text(value)) : number_text(value);
}

template <class Items, class Text>
std::string list_text(const Items& items, Text text) {
  std::string out = "[";
  for (const auto& item : items) out += (out.size() > 1 ? ", " : "") + text(item);
  return out + "]";
}

std::string range_line(const Range& range) {
  std::string out = in_quotes(range.key->full_name()) + " = ";
  if (!range.values.empty())
    return out + list_text(range.values, [&](double v) { return value_text(*range.key, v); }) + "\n";
  out += "{ from = " + number_text(range.from) + ", to = " + number_text(range.to);
  if (range.count > 0) out += ", count = " + std::to_string(range.count);
  return out + ", scale = " + in_quotes(kScaleNames[range.logarithmic ? 1 : 0]) + " }\n";
}

std::string base_text(const Preset& base) {
  std::string out;
  for (const PresetKey& key : preset_keys())
    out += in_quotes(key.full_name()) + " = " + value_text(key, key.get(base)) + "\n";
  return out;
}

std::string reading_text(const Plan& plan) {
  std::string out;
  for (const FileUnit& unit : kFileUnits)
    if (unit.metres == plan.metres_per_unit) out += "unit = " + in_quotes(unit.name) + "\n";
  if (plan.reading.fit_m) out += "fit_mm = " + number_text(*plan.reading.fit_m / kMillimetre) + "\n";
  out += "normals = " + in_quotes(kNormalNames[static_cast<std::size_t>(plan.reading.normals)]) + "\n";
  out += "crease_deg = " + number_text(plan.reading.crease_rad / kDegree) + "\n";
  return out + "turn_over = " + (plan.reading.turn_over ? "true\n" : "false\n");
}

}  // namespace

Result<Plan> parse_plan(std::string_view text, const std::filesystem::path& file) {
  const Result<toml::table> root = parse_toml(text, file.string(), "mend the plan");
  if (!root) return tl::unexpected(root.error());
  return PlanReader(file).read(*root);
}

Result<Plan> read_plan(const std::filesystem::path& file) {
  const Result<std::string> text = read_input_file(file, kMaxPlanBytes);
  if (!text) return tl::unexpected(text.error());
  return parse_plan(*text, file);
}

std::string format_plan(const Plan& plan, const std::vector<std::string>& files) {
  std::vector<std::string> names = files;
  if (names.empty()) {
    for (const auto& mesh : plan.meshes) names.push_back(mesh.string());
    names.insert(names.end(), plan.poses.begin(), plan.poses.end());
  }
  const auto split = names.begin() + static_cast<std::ptrdiff_t>(plan.meshes.size());
  std::string out = "[plan]\n";
  out += "meshes = " + list_text(std::vector<std::string>(names.begin(), split), in_quotes) + "\n" + reading_text(plan);
  out += "poses = " + list_text(std::vector<std::string>(split, names.end()), in_quotes) + "\n";
  out += "methods = " + list_text(plan.methods, [](Method m) { return in_quotes(to_string(m)); }) + "\n";
  out += "sampling = " + in_quotes(kSamplingNames[static_cast<std::size_t>(plan.sampling)]) + "\n";
  if (plan.samples > 0) out += "samples = " + std::to_string(plan.samples) + "\n";
  out += "seed = " + std::to_string(plan.seed) + "\n";
  if (plan.ticks > 0) out += "ticks = " + std::to_string(plan.ticks) + "\n";
  out += "\n[plan.base]\n" + base_text(plan.base) + "\n[ranges]\n";
  for (const Range& range : plan.ranges) out += range_line(range);
  for (const Finger& finger : plan.fingers) {
    Preset preset;
    preset.finger = finger;
    out += "\n[[fingers]]\n";
    for (const PresetKey& key : preset_keys())
      if (key.table == "finger") out += std::string(key.key) + " = " + value_text(key, key.get(preset)) + "\n";
  }
  return out;
}

}  // namespace tangent::sweep
