// Keys that change nothing: who sweeps or tunes one tries the same preset again and again, and is told so.
#pragma once

#include "workbench/sweep/cells.h"

#include <span>
#include <string>
#include <vector>

namespace tangent::sweep {

/// Why no tick of a 3D scene under this preset depends on the key; empty: one may. What it says holds to the last bit,
/// of contacts, forces and display; what it leaves out may still change nothing.
std::string why_ignored(const PresetKey& key, const Preset& preset);

/// A sentence for each key that changes no cell under one of the methods or more: the key, those methods, why. Of plans
/// of many cells evenly spread ones are looked at.
std::vector<std::string> ignored_key_texts(const Cells& cells);

/// The same for keys that are searched from one preset.
std::vector<std::string> ignored_key_texts(std::span<const Range> ranges, const Preset& base);

}  // namespace tangent::sweep
