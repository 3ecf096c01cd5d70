// Computes a map over the whole surface in background threads of low priority. The owner polls progress and partial
// values, and can cancel; all calls come from the owner's thread.
#pragma once

#include "core/lab/measure/surface_map.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <thread>
#include <vector>

namespace tangent {

class SurfaceMapJob {
 public:
  ~SurfaceMapJob();

  /// Cancels a running job and computes this group for every usable triangle, in an order scattered over the surface.
  /// `threads` 0: the machine's threads less those for servo and window, at most four.
  void start(std::shared_ptr<const ContactScene> scene, const Preset& preset, const MapOptions& options, MapGroup group,
             unsigned threads = 0);
  void cancel();  ///< keeps the values computed so far
  void wait();    ///< blocks until done: for screenshots and tests

  bool running() const { return done_places() < places() && !cancelled_.load(std::memory_order_relaxed); }
  double progress() const {
    return places() > 0 ? static_cast<double>(done_places()) / static_cast<double>(places()) : 0.0;
  }
  std::size_t places() const { return places_; }  ///< usable triangles x level^2; 0: nothing was started
  std::size_t done_places() const { return done_.load(std::memory_order_acquire); }

  /// Copies a quantity of the group; index: usable triangle * level^2 + part. May be called while it is computed;
  /// values not computed yet are kMapPending. Empty if the quantity does not belong to the group.
  void copy_values(MapQuantity quantity, std::vector<float>& out) const;
  /// Group and options of the last start.
  MapGroup group() const { return group_; }
  const MapOptions& options() const { return options_; }
  /// Triangle numbers of the usable triangles, in the order of the values.
  std::span<const std::uint32_t> triangles() const { return triangles_; }

 private:
  void work(const std::shared_ptr<const ContactScene>& scene, const Preset& preset);

  MapOptions options_;
  MapGroup group_ = MapGroup::shape;
  std::vector<std::uint32_t> triangles_;
  std::size_t places_ = 0, stride_ = 1;
  std::array<std::vector<float>, kMapQuantityCount> values_;  // written with atomic_ref
  std::atomic<std::size_t> next_{0}, done_{0};
  std::atomic<bool> cancelled_{true};
  std::vector<std::thread> threads_;
};

}  // namespace tangent
