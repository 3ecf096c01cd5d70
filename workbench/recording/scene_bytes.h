// What a scene is built from, as bytes in a recording: the mesh as its file had it and the options it was read with,
// or the polygon of a 2D scene. Building is deterministic, so the scene is the same again, bit for bit.
#pragma once

#include "core/mesh/contact_mesh.h"
#include "core/planar/polygon.h"
#include "core/tick/scene.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tangent {

/// One of the two is set.
struct SceneSource {
  std::shared_ptr<const PolygonMesh> mesh;  ///< metres
  ContactMeshOptions options;               ///< of the mesh
  std::shared_ptr<const PlanarPolygon> polygon;

  const std::string& name() const { return mesh ? mesh->name : polygon->name; }
};

/// The polygon of a 2D scene, as it was used. Precondition: scene.planar().
SceneSource source_of_planar(const ContactScene& scene);

/// Of what ticks read: ContactMesh::content_hash, or of the polygon's vertices. 16 hex digits.
std::string scene_hash(const ContactScene& scene);

std::vector<unsigned char> scene_bytes(const SceneSource& source);
/// Fails on bytes that are none of a scene. `name` goes into it, for messages.
Result<SceneSource> scene_source_from(std::span<const unsigned char> bytes, const std::string& name);
Result<std::shared_ptr<const ContactScene>> build_scene(const SceneSource& source, const SceneParts& parts = {},
                                                        const RunBoth& run_both = run_in_turn);

}  // namespace tangent
