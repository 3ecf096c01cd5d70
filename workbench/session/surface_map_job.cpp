#include "workbench/session/surface_map_job.h"

#include "workbench/session/background_thread.h"

#include <algorithm>
#include <numeric>

namespace tangent {
namespace {

constexpr std::size_t kBatch = 16;  // triangles per batch; a cancel waits for a batch at most

/// A stride near the golden section of n and coprime to n: it visits all of 0..n-1, evenly spread at any time.
std::size_t scattering_stride(std::size_t n) {
  std::size_t stride = std::max<std::size_t>(1, static_cast<std::size_t>(0.618033988749895 * static_cast<double>(n)));
  while (std::gcd(stride, n) != 1) ++stride;
  return stride;
}

unsigned thread_count(unsigned asked) {
  if (asked > 0) return asked;
  const unsigned there = std::max(1u, std::thread::hardware_concurrency());
  return std::clamp(there > 2 ? there - 2 : 1u, 1u, 4u);
}

}  // namespace

SurfaceMapJob::~SurfaceMapJob() { cancel(); }

void SurfaceMapJob::cancel() {
  cancelled_.store(true, std::memory_order_relaxed);
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

void SurfaceMapJob::wait() {
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

void SurfaceMapJob::start(std::shared_ptr<const ContactScene> scene, const Preset& preset, const MapOptions& options,
                          MapGroup group, unsigned threads) {
  cancel();
  options_ = options;
  options_.level = std::clamp(options_.level, 1u, kLargestMapLevel);
  group_ = group;
  const ContactMesh& mesh = scene->mesh();
  triangles_.clear();
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.usable(t)) triangles_.push_back(t);
  }
  places_ = triangles_.size() * options_.level * options_.level;
  stride_ = scattering_stride(triangles_.size());
  for (std::size_t q = 0; q < kMapQuantityCount; ++q) {
    if (group_of(static_cast<MapQuantity>(q)) == group)
      values_[q].assign(places_, kMapPending);
    else
      values_[q] = {};
  }
  next_.store(0, std::memory_order_relaxed);
  done_.store(0, std::memory_order_relaxed);
  cancelled_.store(false, std::memory_order_relaxed);
  for (unsigned i = 0; i < thread_count(threads); ++i)
    threads_.emplace_back([this, scene, preset] { work(scene, preset); });
}

void SurfaceMapJob::work(const std::shared_ptr<const ContactScene>& scene, const Preset& preset) {
  yield_to_servo_and_window();
  SurfaceMapper mapper(scene, preset, options_);
  const unsigned parts = options_.level * options_.level;
  MapValues values{};
  for (;;) {
    const std::size_t first = next_.fetch_add(kBatch, std::memory_order_relaxed);
    if (first >= triangles_.size()) return;
    const std::size_t last = std::min(first + kBatch, triangles_.size());
    for (std::size_t i = first; i < last; ++i) {
      if (cancelled_.load(std::memory_order_relaxed)) return;
      const std::size_t triangle = i * stride_ % triangles_.size();
      for (unsigned part = 0; part < parts; ++part) {
        mapper.compute(group_, triangles_[triangle], part, values);
        for (std::size_t q = 0; q < kMapQuantityCount; ++q) {
          if (!values_[q].empty())
            std::atomic_ref(values_[q][triangle * parts + part]).store(values[q], std::memory_order_relaxed);
        }
      }
      done_.fetch_add(parts, std::memory_order_release);
    }
  }
}

void SurfaceMapJob::copy_values(MapQuantity quantity, std::vector<float>& out) const {
  const std::vector<float>& from = values_[static_cast<std::size_t>(quantity)];
  out.resize(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    out[i] = std::atomic_ref(const_cast<float&>(from[i])).load(std::memory_order_relaxed);
  }
}

}  // namespace tangent
