// Finds the mesh and the motion that a preset's evidence names, and measures along them.
#pragma once

#include "core/base/result.h"
#include "core/io/preset_evidence.h"
#include "core/tick/step.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace tangent {

struct EvidenceRun {
  std::string mesh_hash, motion_digest;  ///< of what was found
  EvidenceNumbers numbers;
};

struct EvidenceOptions {
  std::filesystem::path folder;  ///< of the preset
  bool timed = false;
  std::function<bool()> keep_going = [] { return true; };
};

/// Solves the evidence's motion on its mesh with `preset`. Motions that the program makes are made for the finger of
/// evidence.values. Fails where the mesh or the motion can't be had; empty: `keep_going` said no.
Result<std::optional<EvidenceRun>> run_evidence(const PresetEvidence& evidence, const Preset& preset,
                                                const EvidenceOptions& options);

/// Measures with evidence.values, and fills in what `asked` says nothing of: hash, digest, ticks of a recording (from
/// 0 to 0: all), numbers, version and build. A mesh file that says how `make` made it is named by that command, if the
/// command makes the same mesh.
Result<std::optional<PresetEvidence>> measure_evidence(PresetEvidence asked, const EvidenceOptions& options);

/// 16 hex digits, of all bits of times, poses and velocities.
std::string motion_digest(std::span<const TickInput> motion);

/// The program as evidence names it: compiler, build, and whether the processor fuses multiply and add, which the C
/// library's sine and cosine depend on.
std::string evidence_build();

/// `file` as seen from `folder`.
std::string seen_from(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace tangent
