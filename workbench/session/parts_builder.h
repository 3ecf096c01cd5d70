// Builds what a large scene leaves to be built late (ContactScene::build_near), so that the servo need not wait for it:
// before it arms what is in reach, then the rest beside it, always the part nearest to the finger.
//
// What is in reach when the servo starts is what ticks at the start of its way search, and kBuiltAhead further: a tenth
// of a second at 0.1 m/s. From there on the builder has to be faster than the finger. Where the finger is faster, the
// tick says so (TickInput::unready) and has no force but that of the last contact, which fades; nothing arms there.
#pragma once

#include "core/finger/finger.h"
#include "core/tick/scene.h"
#include "devices/base/mailbox.h"

#include <atomic>
#include <memory>
#include <thread>

namespace tangent {

inline constexpr double kBuiltAhead_m = 10e-3;

/// Takes up to a second of two threads on millions of triangles. World frame.
void build_in_reach(const ContactScene& scene, const Vec3& start_m, const Finger& finger);

/// The rest, in a thread of its own. One thread owns it.
class PartsBuilder {
 public:
  PartsBuilder(std::shared_ptr<const ContactScene> scene, const Vec3& finger_m);
  /// Returns when the part at hand is built: milliseconds.
  ~PartsBuilder();
  PartsBuilder(const PartsBuilder&) = delete;
  PartsBuilder& operator=(const PartsBuilder&) = delete;

  void finger_is_at(const Vec3& position_m) { finger_.put(position_m); }
  bool done() const { return done_.load(std::memory_order_acquire); }

 private:
  void build(Vec3 finger_m);

  std::shared_ptr<const ContactScene> scene_;
  Mailbox<Vec3> finger_;
  std::atomic<bool> stopping_{false}, done_{false};
  std::thread thread_;
};

}  // namespace tangent
