// [about.measured] of a preset file, read and written.
#pragma once

#include "core/base/result.h"
#include "core/io/preset_evidence.h"

#include <toml++/toml.h>

#include <string>

namespace tangent {

/// `name` stands for the file in messages. Fails on unknown keys, on missing ones and on values that can't be.
Result<PresetEvidence> read_evidence(const toml::table& table, const std::string& name);

/// The tables [about.measured] and [about.measured.values].
std::string evidence_text(const PresetEvidence& evidence);

}  // namespace tangent
