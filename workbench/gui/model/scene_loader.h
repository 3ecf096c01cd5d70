// Opens a mesh in a worker thread: reads or generates it, builds the contact scene, prepares it for the servo, and then
// audits it while it is already in use. The window polls once per frame.
#pragma once

#include "core/lab/audit/mesh_audit.h"
#include "core/lab/audit/mesh_findings.h"
#include "core/lab/measure/perception.h"
#include "core/tick/step.h"
#include "workbench/session/session.h"

#include <future>
#include <memory>
#include <optional>
#include <string>

namespace tangent {

/// What to open: a file, or the name of a generated object (generator_names()).
struct SceneRequest {
  std::string mesh;
  double metres_per_unit = 1e-3;
  ContactMeshOptions options;
  Finger finger;
  std::shared_ptr<const PolygonMesh> polygons;  ///< set when already read: only rebuilds with other options
};

/// Audit and perception report of a mesh.
struct MeshReport {
  MeshAudit audit;
  MeshFindings findings;
  PerceptionAudit perception;
};

struct LoadedScene {
  std::shared_ptr<const PolygonMesh> polygons;
  std::shared_ptr<const ContactScene> scene;
  PreparedScenePtr prepared;
  ContactMeshOptions options;  ///< with which it was built, where it is a mesh
  double seconds = 0.0;
  bool rebuilt = false;  ///< from polygons already in memory
};

MeshReport report_on(const PolygonMesh& polygons, const ContactMesh& mesh);

/// What a scene without polygons is audited as: of a polygon its ribbon. Null: nothing.
std::shared_ptr<const PolygonMesh> polygons_of(const ContactScene& scene, std::shared_ptr<const PolygonMesh> polygons);
/// A scene that was built already, and what it was built from: no mesh where it is a polygon.
LoadedScene load_built(std::shared_ptr<const ContactScene> scene, std::shared_ptr<const PolygonMesh> polygons,
                       const Finger& finger);
/// Loads in the calling thread. A generator's name without dot or slash means the generated object.
Result<LoadedScene> load_scene(const SceneRequest& request);

class SceneLoader {
 public:
  /// Replaces a request that has not started; one in progress is finished and its result discarded.
  void request(SceneRequest request);
  /// Starts a waiting request. Returns the result of each finished load once.
  std::optional<Result<LoadedScene>> poll();
  bool busy() const { return loading_.valid() || waiting_.has_value(); }
  const std::string& name() const { return name_; }

  void request_audit(std::shared_ptr<const PolygonMesh> polygons, std::shared_ptr<const ContactScene> scene);
  /// The audit of the latest request, once, when it is done.
  std::optional<MeshReport> poll_audit();
  bool auditing() const { return audit_.valid() || audit_waiting_.scene != nullptr; }

 private:
  struct AuditRequest {
    std::shared_ptr<const PolygonMesh> polygons;
    std::shared_ptr<const ContactScene> scene;
  };
  std::future<Result<LoadedScene>> loading_;
  std::optional<SceneRequest> waiting_;
  std::string name_;
  std::future<MeshReport> audit_;
  AuditRequest audit_waiting_;
};

}  // namespace tangent
