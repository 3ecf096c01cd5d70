// Every tunable value of a preset, described once: its key on disk, unit, allowed range, meaning, option, who reads it
// and when it counts. The preset files, the command line, the panels and whoever asks what has to be solved again read
// this table, so a value has the same name, range and explanation wherever it turns up. A new field of
// core/preset/preset.h needs one row in schema.cpp and nothing else.
#pragma once

#include "core/base/result.h"
#include "core/preset/preset.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace tangent {

enum class KeyKind : std::uint8_t {
  number,
  integer,
  choice,  ///< the value is an index into `choices`
};

/// A set of methods.
struct Methods {
  std::uint32_t bits = 0;
  constexpr bool has(Method method) const { return (bits >> static_cast<unsigned>(method) & 1u) != 0; }
  constexpr bool operator==(const Methods&) const = default;
};
constexpr Methods only(Method method) { return {1u << static_cast<unsigned>(method)}; }
inline constexpr Methods kNoMethod{}, kEveryMethod{(1u << kMethodNames.size()) - 1u};

/// For a value that counts only under some values of others.
struct KeyCondition {
  bool (*holds)(const Preset&) = nullptr;  ///< null: always
  std::string_view otherwise = {};  ///< why it changes nothing; empty: it has no meaning then, panels leave it out
};

/// One tunable value. Values travel as double, whatever the kind: integers and indices are exact in it.
struct PresetKey {
  std::string_view table;  ///< "solver"
  std::string_view key;    ///< "gain_overall": the name in core/preset/preset.h (an ellipsoid's axes are three keys)
  KeyKind kind = KeyKind::number;
  std::string_view label;                     ///< short name for a panel
  std::string_view unit = {};                 ///< SI: "m", "1/m"; "1" for a pure number; empty for choices
  std::string_view doc;                       ///< what it does, one or two sentences
  double min = 0.0, max = 0.0;                ///< allowed, both ends included
  double slider_min = 0.0, slider_max = 0.0;  ///< where tuning usually happens
  bool logarithmic = false;                   ///< spans several powers of ten
  std::span<const std::string_view> choices = {};
  Methods read_by = kNoMethod;       ///< methods whose contact depends on it; none: it comes in after solving
  bool planar_only = false;          ///< 2D scenes alone read it
  bool needs_controller = false;     ///< taken by a display that has a controller of its own, and by nothing else
  bool tuned = false;                ///< a gain of Eq. 1, which is found by measuring (core/lab/gains)
  KeyCondition condition = {};       ///< beside what the four say
  std::string_view option = {};      ///< long option of the command line without the dashes; empty: `--set` alone
  double option_per_si = 1.0;        ///< what 1 in SI is in the option's unit (1e6 for --tolerance-um)
  std::string_view option_doc = {};  ///< what the option does besides
  void (*option_set)(Preset&, double) = nullptr;  ///< in place of `set`, for such an option
  double (*get)(const Preset&) = nullptr;
  void (*set)(Preset&, double) = nullptr;  ///< precondition: allows(value)

  std::string full_name() const;  ///< "solver.gain_overall"
  double default_value() const;
  bool allows(double value) const;                ///< finite, in range, whole unless a number
  std::string allowed() const;                    ///< "0 to 10", "1e-12 to 0.001 m", "paper, newton or robust"
  int choice_index(std::string_view name) const;  ///< -1: no such choice
  std::string value_text(double value) const;     ///< as a preset file writes it, without quotes
};

/// Rows that belong together: a table of the file, a group of a panel.
struct PresetTable {
  std::string_view name;   ///< "solver"
  std::string_view title;  ///< "Solver"
  bool seldom = false;     ///< set once for a device or a study rather than tuned: panels start it folded
};

std::span<const PresetKey> preset_keys();                                        ///< table by table
std::span<const PresetTable> preset_tables();                                    ///< in the order of the file
const PresetKey* find_preset_key(std::string_view table, std::string_view key);  ///< nullptr: no such key
const PresetKey* find_preset_key(std::string_view full_name);                    ///< "solver.gain_overall"

/// Whether the method finds the same contact under both presets, from the same state and input: it is the same method,
/// and so is every value that it reads. What sources of force and display ask for besides is not compared.
bool same_for_solver(const Preset& a, const Preset& b);

/// Fails on the first value outside its range, naming key and range.
Status check_preset(const Preset& preset);

/// "0 to 10 m": a range with its unit.
std::string range_text(double min, double max, std::string_view unit);
/// "a, b or c".
std::string choices_text(std::span<const std::string_view> choices);

}  // namespace tangent
