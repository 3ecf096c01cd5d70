// Prepares a scene's vertex arrays on a thread of its own, first what can be drawn at once (facets, a
// stand-in for motion, feature edges), then the smooth surface. The drawing thread polls and never waits.
#pragma once

#include "core/tick/step.h"
#include "workbench/gui/render/surface_mesh.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace tangent {

/// The stand-in has at most about so many triangles.
inline constexpr std::size_t kStandInTriangles = 24'000;

struct CoarseArrays {
  std::vector<FacetVertex> facets;
  SurfaceMesh stand_in;  ///< with corner normals, coarser than the mesh if that is large
  std::vector<FeatureEdge> edges;
};

class SurfaceWorker {
 public:
  ~SurfaceWorker();

  /// Drops whatever is under way and starts on this scene.
  void start(std::shared_ptr<const ContactScene> scene, NormalForm form, double scale_m, std::size_t triangle_budget);
  void stop();

  /// What was finished since the last call; each comes once.
  std::optional<CoarseArrays> take_coarse();
  std::optional<SurfaceMesh> take_smooth();

  float progress() const { return progress_.load(std::memory_order_relaxed); }
  void wait();  ///< until all is finished

 private:
  void work(std::stop_token stop, std::shared_ptr<const ContactScene> scene, NormalForm form, double scale_m,
            std::size_t triangle_budget);

  std::mutex guard_;  // of the two results
  std::optional<CoarseArrays> coarse_;
  std::optional<SurfaceMesh> smooth_;
  std::atomic<float> progress_{0.0f};
  std::jthread thread_;
};

}  // namespace tangent
