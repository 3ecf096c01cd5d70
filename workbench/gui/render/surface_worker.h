// Prepares a scene's vertex arrays in its own thread: first what can be drawn at once (facets, a stand-in for motion,
// feature edges), then the smooth surface. The drawing thread polls and never waits.
#pragma once

#include "core/tick/step.h"
#include "workbench/gui/render/surface_mesh.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace tangent {

/// Approximate upper limit of the stand-in's triangles.
inline constexpr std::size_t kStandInTriangles = 24'000;

struct CoarseArrays {
  std::vector<FacetVertex> facets;
  SurfaceMesh stand_in;  ///< with corner normals, coarser than the mesh if that is large
  std::vector<FeatureEdge> edges;
};

class SurfaceWorker {
 public:
  ~SurfaceWorker();

  /// Cancels a job in progress and starts on this scene.
  void start(std::shared_ptr<const ContactScene> scene, NormalForm form, double scale_m, std::size_t triangle_budget);
  void stop();

  /// Results finished since the last call; each is returned once.
  std::optional<CoarseArrays> take_coarse();
  std::optional<SurfaceMesh> take_smooth();

  float progress() const { return progress_.load(std::memory_order_relaxed); }
  void wait();  ///< until all is finished

 private:
  void work(std::stop_token stop, std::shared_ptr<const ContactScene> scene, NormalForm form, double scale_m,
            std::size_t triangle_budget);

  std::mutex guard_;  // guards the two results
  std::optional<CoarseArrays> coarse_;
  std::optional<SurfaceMesh> smooth_;
  std::atomic<float> progress_{0.0f};
  std::jthread thread_;
};

}  // namespace tangent
