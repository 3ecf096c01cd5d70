// What a preset's values were measured with, so that anybody can measure it again: [about.measured] of a preset file.
// Numbers and names only; workbench/evidence measures and checks.
#pragma once

#include "core/mesh/contact_mesh.h"
#include "core/preset/schema.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace tangent {

enum class MotionKind : std::uint8_t {
  around,    ///< made by the program: all over the mesh
  strokes,   ///< made by the program: left and right, forward and back
  poses,     ///< of a pose file
  recording  ///< of a recording
};
inline constexpr std::array<std::string_view, 4> kMotionKinds{"around", "strokes", "poses", "recording"};

struct EvidenceMotion {
  MotionKind kind = MotionKind::around;
  double version = 0.0;  ///< of a motion that the program makes: one counts up whenever the program makes it otherwise
  std::string file;      ///< of the others, as seen from the preset's folder
  double first_tick = 0.0, last_tick = 0.0;  ///< of a recording, both included
  std::string digest;                        ///< 16 hex digits, of all bits of its times and poses
  bool operator==(const EvidenceMotion&) const = default;
};

struct EvidenceMesh {
  /// "make octagon --rounding-mm 1.5", or a file, as seen from the preset's folder; empty: the recording's own.
  std::string source;
  std::string hash;  ///< 16 hex digits
  double metres_per_unit = kMillimetre;
  ContactMeshOptions options;
  bool operator==(const EvidenceMesh&) const = default;
};

/// Of all ticks of a motion, solved in turn from nothing. Counts, but for those with a unit in their names.
struct EvidenceNumbers {
  double ticks = 0.0;
  double touching_ticks = 0.0;     ///< not free
  double unconverged_ticks = 0.0;  ///< of those
  double reseeded_ticks = 0.0;
  double events = 0.0;                          ///< ticks with one of any kind
  double mean_planes = 0.0;                     ///< tangent planes a tick
  double p99_planes = 0.0, worst_planes = 0.0;  ///< nearest rank
  double compared_ticks = 0.0;                  ///< converged, with a solution to 1e-12 of the scene's size nearby
  /// Distance of the contact from that solution's, of the compared ticks; 0 in 2D and for methods on the raw mesh.
  double error_median_um = 0.0, error_p99_um = 0.0, error_worst_um = 0.0;
  double residual_worst_um = 0.0;  ///< largest error of a converged tick by its own account
  double force_mean_n = 0.0, force_worst_n = 0.0;
  double display_mean_mm = 0.0;  ///< of its distance from the middle
  double median_solve_ns = 0.0;  ///< 0: no time was taken. Kept, never compared
  bool operator==(const EvidenceNumbers&) const = default;
};

enum class Compared : std::uint8_t { exactly, within_rounding, never };
struct EvidenceNumber {
  std::string_view key;
  double EvidenceNumbers::*field;
  Compared compared;
};
/// All of them, in the order of a file.
std::span<const EvidenceNumber> evidence_numbers();

struct PresetEvidence {
  std::string command;          ///< that measured
  std::string program_version;  ///< of the program that did
  std::string build;            ///< of the same; which numbers must be the same to the last bit
  EvidenceMotion motion;
  EvidenceMesh mesh;
  EvidenceNumbers numbers;
  Preset values;  ///< measured with; those of in_evidence() are written
  /// Where a file was edited: the digest that stands in it, which is of other numbers than these. Written again as it
  /// is; without one the digest of what is written is.
  std::string edited_digest;
  bool operator==(const PresetEvidence&) const = default;
};

/// Whether a tick may read this key, so that it belongs to what was measured: all but the display's controller.
bool in_evidence(const PresetKey& key);

}  // namespace tangent
