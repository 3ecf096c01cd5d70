// Grounds of a tuning: the meshes, motions and fingers that one preset has to be good on.
#pragma once

#include "core/preset/preset.h"
#include "workbench/cli/mesh_options.h"
#include "workbench/sweep/front_plan.h"

#include <string>
#include <vector>

namespace tangent {

struct TuneGroundOptions {
  std::vector<std::string> poses;   ///< pose files, recordings, or made motions; empty: the command's --path
  std::vector<std::string> meshes;  ///< besides MESH
  std::vector<double> radii_m;      ///< of the finger, besides the preset's
  bool several() const { return poses.size() > 1 || !meshes.empty() || !radii_m.empty(); }
};

/// --poses, --also-mesh, --also-radius-mm. `options` must outlive the parser.
void add_tune_ground_options(CLI::App& app, TuneGroundOptions& options);

struct TuneGrounds {
  std::vector<sweep::FrontGround> all;  ///< every motion on every mesh under every finger; the first is MESH's
  std::vector<std::string> failed;      ///< why others can't be had
  std::vector<std::string> notes;       ///< on those, but for the first, of which nothing is touched
};

/// `first`: MESH and its first motion. The last quarter of every motion is held back.
TuneGrounds tune_grounds(const TuneGroundOptions& options, const MeshOptions& mesh, const Preset& preset,
                         const sweep::Ground& first, const std::string& first_motion);

}  // namespace tangent
