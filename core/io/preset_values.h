// Single values of a preset in TOML, by the table of core/preset/schema.h.
#pragma once

#include "core/base/result.h"
#include "core/preset/schema.h"

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace tangent {

/// Sets one key of `preset`. `where`: the file and line, for messages. Fails on an unknown key, a wrong type and a
/// value out of range.
Status read_preset_value(std::string_view table, const toml::key& key, const toml::node& node, const std::string& where,
                         Preset& preset);

/// "solver.gain_overall = 1.36" without the key: text in quotes, whole numbers without a point.
std::string value_literal(const PresetKey& row, double value);

}  // namespace tangent
