// Report of a solve, as text and as JSON.
#pragma once

#include "core/io/preset_file.h"
#include "core/lab/explain/tick_cause.h"
#include "core/mesh/contact_mesh.h"
#include "core/planar/curve.h"
#include "workbench/cli/solve_statistics.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tangent {

struct SolveReport {
  const ContactMesh* mesh = nullptr;    ///< null: a 2D scene
  const PlanarCurve* planar = nullptr;  ///< null: a 3D scene
  PresetFile preset;
  std::string preset_name;  ///< file, or "built-in values"
  std::string poses_name;
  std::uint64_t poses = 0;
  bool interrupted = false;
  std::size_t scene_bytes = 0;  ///< mesh or curve, and what searches read of it
  double load_seconds = 0.0;    ///< poses, mesh, query structure
  double solve_seconds = 0.0;   ///< ticks and their output
  SolveStatistics statistics;
  std::optional<std::array<std::uint64_t, kTickCauses.size()>> causes;  ///< with --explain: how often each was told

  std::string touch_note;  ///< on a motion that touches nothing; empty: it does

  std::vector<std::string> notes() const;  ///< on the mesh, and on the finger where it does not fit the mesh
};

/// A dozen lines for a terminal.
std::string solve_text(const SolveReport& report);
/// The layout is documented and stable (workbench/README.md, "Files").
nlohmann::ordered_json solve_json(const SolveReport& report);

}  // namespace tangent
