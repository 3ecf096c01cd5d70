// What decides what a tuning tries, and what its trials give.
#include "core/base/fnv.h"
#include "core/base/text.h"
#include "workbench/recording/build_identity.h"
#include "workbench/recording/scene_bytes.h"
#include "workbench/sweep/front_search.h"
#include "workbench/sweep/tuning_file.h"

#ifndef TANGENT_VERSION
#define TANGENT_VERSION "unknown"
#endif

namespace tangent::sweep {
namespace {

class TuningDigest {
 public:
  TuningDigest() { text(TANGENT_VERSION).text(build_identity()); }

  TuningDigest& text(std::string_view part) {
    whole(part.size());
    fnv_.add(part);
    return *this;
  }
  /// To the bit.
  TuningDigest& number(double value) {
    std::string shortest;
    append_double(shortest, value);
    return text(shortest);
  }
  TuningDigest& whole(std::uint64_t value) {
    fnv_.add(std::to_string(value) + ";");
    return *this;
  }
  TuningDigest& preset(const Preset& preset) {
    for (const PresetKey& key : preset_keys()) number(key.get(preset));
    return *this;
  }
  TuningDigest& motion(std::span<const TickInput> motion) {
    whole(motion.size());
    for (const TickInput& input : motion) {
      number(input.t_s).vec(input.finger.position);
      const auto& turn = input.finger.orientation;
      number(turn.w).number(turn.x).number(turn.y).number(turn.z);
      whole(input.velocity ? 1 : 0).vec(input.velocity.value_or(Vec3{0.0}));
    }
    return *this;
  }
  std::string done() const { return fnv_.text(); }

 private:
  TuningDigest& vec(const Vec3& v) { return number(v.x).number(v.y).number(v.z); }
  Fnv fnv_;
};

void add_ground(TuningDigest& digest, const FrontGround& on) {
  Preset finger;
  finger.finger = on.finger.value_or(Finger{});
  digest.text(scene_hash(*on.ground.scene)).motion(*on.ground.motion).whole(on.ticks);
  digest.whole(on.finger ? 1 : 0).preset(finger);
}

}  // namespace

std::string tuning_digest(const FrontPlan& plan, const std::vector<FrontGround>& grounds) {
  TuningDigest digest;
  digest.text("front").text(has_front_search() && plan.evolve ? "evolved" : "drawn").preset(plan.base);
  for (const Range& range : plan.ranges)
    digest.text(range.key->full_name()).number(range.from).number(range.to).whole(range.logarithmic ? 1 : 0);
  for (const Objective& objective : plan.objectives) digest.text("objective").text(objective.column->name);
  for (const Constraint& constraint : plan.constraints)
    digest.text("constraint").text(constraint.of.name()).number(constraint.most);
  for (const Preset& start : plan.starts) digest.preset(start);
  digest.whole(plan.evaluations).whole(plan.seed).whole(static_cast<std::uint64_t>(plan.over_grounds));
  digest.whole(plan.race ? 1 : 0);
  for (const FrontGround& on : grounds) add_ground(digest, on);
  return digest.done();
}

std::string tuning_digest(const Preset& base, const ContactScene& scene, std::span<const TickInput> poses) {
  return TuningDigest().text("gains").preset(base).text(scene_hash(scene)).motion(poses).done();
}

}  // namespace tangent::sweep
