#include "workbench/gui/render/surface_worker.h"

#include <utility>

namespace tangent {

SurfaceWorker::~SurfaceWorker() { stop(); }

void SurfaceWorker::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
  const std::scoped_lock lock(guard_);
  coarse_.reset();
  smooth_.reset();
}

void SurfaceWorker::start(std::shared_ptr<const ContactScene> scene, NormalForm form, double scale_m,
                          std::size_t triangle_budget) {
  stop();
  progress_.store(0.0f, std::memory_order_relaxed);
  thread_ = std::jthread([this, scene = std::move(scene), form, scale_m, triangle_budget](std::stop_token token) {
    work(std::move(token), scene, form, scale_m, triangle_budget);
  });
}

void SurfaceWorker::work(std::stop_token stop, std::shared_ptr<const ContactScene> scene, NormalForm form,
                         double scale_m, std::size_t triangle_budget) {
  const ContactMesh& mesh = scene->mesh();
  CoarseArrays coarse{facet_vertices(mesh, scale_m),
                      mesh.usable_triangle_count() <= kStandInTriangles
                          ? corner_normal_mesh(mesh, scale_m)
                          : clustered_mesh(mesh, scale_m, kStandInTriangles),
                      feature_edges(mesh, scale_m)};
  if (stop.stop_requested()) return;
  {
    const std::scoped_lock lock(guard_);
    coarse_ = std::move(coarse);
  }
  const unsigned level = level_within(triangle_budget, mesh.usable_triangle_count());
  SurfaceMesh smooth = tessellate(mesh, form, level, scale_m, progress_, stop);
  if (stop.stop_requested()) return;
  const std::scoped_lock lock(guard_);
  smooth_ = std::move(smooth);
}

std::optional<CoarseArrays> SurfaceWorker::take_coarse() {
  const std::scoped_lock lock(guard_);
  return std::exchange(coarse_, std::nullopt);
}

std::optional<SurfaceMesh> SurfaceWorker::take_smooth() {
  const std::scoped_lock lock(guard_);
  return std::exchange(smooth_, std::nullopt);
}

void SurfaceWorker::wait() {
  if (thread_.joinable()) thread_.join();
}

}  // namespace tangent
