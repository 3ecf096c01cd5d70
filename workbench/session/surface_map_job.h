// A map over the whole surface, computed in the background: progress, cancel, and the values so far at any time.
// Threads of lower priority than the rest of the program; the owner polls and never waits.
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

  /// Drops what is under way and computes this group for every usable triangle, in an order scattered over the
  /// surface. `threads` 0: one less than the machine has for servo and window, at most four.
  void start(std::shared_ptr<const ContactScene> scene, const Preset& preset, const MapOptions& options, MapGroup group,
             unsigned threads = 0);
  void cancel();  ///< what is done stays
  void wait();    ///< until it is done: for pictures and tests

  bool running() const { return done_places() < places() && !cancelled_.load(std::memory_order_relaxed); }
  double progress() const {
    return places() > 0 ? static_cast<double>(done_places()) / static_cast<double>(places()) : 0.0;
  }
  std::size_t places() const { return places_; }  ///< usable triangles x level^2; 0: nothing was started
  std::size_t done_places() const { return done_.load(std::memory_order_acquire); }

  /// Copies a quantity of the group: index `usable triangle` * level^2 + part. Safe while it is computed; values are
  /// kMapPending where they are not there yet. Empty if the quantity is not of the group.
  void copy_values(MapQuantity quantity, std::vector<float>& out) const;
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
