#include "workbench/session/parts_builder.h"

#include "workbench/session/two_threads.h"

namespace tangent {

void build_in_reach(const ContactScene& scene, const Vec3& start_m, const Finger& finger) {
  scene.build_near(start_m, finger.reach_m(), run_on_two_threads, kBuiltAhead_m);
}

PartsBuilder::PartsBuilder(std::shared_ptr<const ContactScene> scene, const Vec3& finger_m)
    : scene_(std::move(scene)), thread_([this, finger_m] { build(finger_m); }) {}

PartsBuilder::~PartsBuilder() {
  stopping_.store(true, std::memory_order_release);
  thread_.join();
}

void PartsBuilder::build(Vec3 finger_m) {
  do {
    finger_.take(finger_m);
  } while (!stopping_.load(std::memory_order_acquire) && scene_->build_next_part(finger_m));
  done_.store(true, std::memory_order_release);
}

}  // namespace tangent
