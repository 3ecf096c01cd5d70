// [about.measured] of a preset file, read and written.
#pragma once

#include "core/base/result.h"
#include "core/io/preset_evidence.h"

#include <toml++/toml.h>

#include <string>

namespace tangent {

/// 16 hex digits, of all keys of [about.measured] and its values but those that say where things lie (command,
/// motion_file, mesh), whose contents have digests of their own, and `digest`. It tells slips of an editor, no forger.
std::string evidence_digest(const toml::table& measured);

/// `name` stands for the file in messages. Fails on unknown keys, on missing ones and on values that can't be.
Result<PresetEvidence> read_evidence(const toml::table& table, const std::string& name);

/// The tables [about.measured] and [about.measured.values].
std::string evidence_text(const PresetEvidence& evidence);

}  // namespace tangent
