// Presets on disk: TOML, one table per group of core/preset/preset.h with its field names as keys, and an [about]
// table that says where the values come from. Missing keys keep their defaults; anything unknown, of the
// wrong type or out of range is an error that names key, line and allowed range (core/preset/schema.h). Above the
// tables stand the key `format` (core/io/file_format.h) and, where wanted, `condition`: a rendering condition of the
// paper, which stands for force.source and display.source.
#pragma once

#include "core/base/result.h"
#include "core/io/preset_evidence.h"
#include "core/preset/preset.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace tangent {

/// Origin of a preset and measurements made with it. Every field may be empty.
struct PresetAbout {
  std::string name;
  std::string date;  ///< ISO 8601: "2026-03-31"
  std::string program_version;
  std::string mesh_name;
  std::string mesh_hash;  ///< ContactMesh::content_hash(), 16 hex digits
  std::string device;
  std::string note;
  double metres_per_unit = 0.0;            ///< of the mesh's file; 0: not said
  double longest_side_m = 0.0;             ///< of the mesh; 0: not said
  std::optional<PresetEvidence> measured;  ///< [about.measured]: what can be measured again
  /// [about.also_measured], in the order of the file: free keys, numbers or text, for people; nobody checks them. In
  /// files up to format 1 all that was measured, as [about.measured].
  std::vector<std::pair<std::string, std::variant<double, std::string>>> also_measured;
  bool operator==(const PresetAbout&) const = default;
};

struct PresetFile {
  PresetAbout about;
  Preset preset;
  operator const Preset&() const { return preset; }  ///< a file of a preset will do wherever a preset is wanted
  bool operator==(const PresetFile&) const = default;
};

/// `name` stands for the file in messages.
Result<PresetFile> parse_preset(std::string_view text, std::string_view name);
Result<PresetFile> read_preset(const std::filesystem::path& path);

/// Writes every key with its unit and range as a comment; numbers read back as exactly the same double.
std::string format_preset(const PresetFile& file);
/// Writes atomically. Fails on a preset with values out of range, so that every written file can be read.
Status write_preset(const PresetFile& file, const std::filesystem::path& path);

}  // namespace tangent
