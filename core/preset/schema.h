// Every tunable value of a preset, described once: its key on disk, unit, allowed range, meaning and option.
// The preset files, the command line and the panels all read this table, so a value has the same name,
// range and explanation wherever it turns up. A new field of core/preset/preset.h needs one row in
// preset_schema.cpp and nothing else.
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

/// One tunable value. Values travel as double, whatever the kind: integers and indices are exact in it.
struct PresetKey {
  std::string_view table;  ///< "solver"
  std::string_view key;    ///< "gain_overall": the name in core/preset/preset.h (an ellipsoid's axes are three keys)
  KeyKind kind = KeyKind::number;
  std::string_view label;                     ///< short name for a panel
  std::string_view unit;                      ///< SI: "m", "1/m"; "1" for a pure number; empty for choices
  std::string_view doc;                       ///< what it does, one or two sentences
  double min = 0.0, max = 0.0;                ///< allowed, both ends included
  double slider_min = 0.0, slider_max = 0.0;  ///< where tuning usually happens
  bool logarithmic = false;                   ///< spans several powers of ten
  std::span<const std::string_view> choices = {};
  std::string_view option = {};       ///< long option of the command line without the dashes; empty: none
  double option_per_si = 1.0;         ///< what 1 in SI is in the option's unit (1e6 for --tolerance-um)
  std::string_view option_unit = {};  ///< unit of the option's number, for messages
  double (*get)(const Preset&) = nullptr;
  void (*set)(Preset&, double) = nullptr;  ///< precondition: allows(value)

  std::string full_name() const;  ///< "solver.gain_overall"
  double default_value() const;
  bool allows(double value) const;                ///< finite, in range, whole unless a number
  std::string allowed() const;                    ///< "0 to 10", "1e-12 to 0.001 m", "paper, newton or robust"
  int choice_index(std::string_view name) const;  ///< -1: no such choice
  std::string value_text(double value) const;     ///< as a preset file writes it, without quotes
};

std::span<const PresetKey> preset_keys();
const PresetKey* find_preset_key(std::string_view table, std::string_view key);  ///< nullptr: no such key
std::span<const std::string_view> preset_tables();  ///< in the order of the file, "about" first

/// Fails on the first value outside its range, naming key and range.
Status check_preset(const Preset& preset);

/// "0 to 10 m": a range with its unit.
std::string range_text(double min, double max, std::string_view unit);
/// "a, b or c".
std::string choices_text(std::span<const std::string_view> choices);

}  // namespace tangent
