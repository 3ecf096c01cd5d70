// Measures a preset and names in it what it was measured with.
#pragma once

#include "core/io/preset_file.h"
#include "workbench/evidence/run_evidence.h"

#include <optional>

namespace tangent {

/// The file with [about.measured] of its own values over the motion and on the mesh that `asked` names, and with date,
/// version and mesh in [about]. Fails as run_evidence does; empty: told to stop.
Result<std::optional<PresetFile>> attach_evidence(PresetFile file, PresetEvidence asked,
                                                  const EvidenceOptions& options);

}  // namespace tangent
