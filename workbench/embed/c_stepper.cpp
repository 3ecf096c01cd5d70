// The C interface: ticks.
#include "workbench/embed/batch.h"
#include "workbench/embed/c_handle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace tangent::c {
namespace {

/// The one thread that may use a stepper now.
class Use {
 public:
  explicit Use(tangent_stepper& stepper)
      : stepper_(stepper), mine_(!stepper.in_use.exchange(true, std::memory_order_acquire)) {}
  ~Use() {
    if (mine_) stepper_.in_use.store(false, std::memory_order_release);
  }
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;
  bool mine() const { return mine_; }

 private:
  tangent_stepper& stepper_;
  bool mine_;
};

Vec3 vector_of(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

double length2(const double (&q)[4]) { return q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]; }
bool has_orientation(const tangent_input& input) { return length2(input.orientation_wxyz) > 0.0; }

/// Null: the pose can be used; else what of it can't.
const char* fault_of(const tangent_input& input) {
  constexpr double kLength2 = 2e-3;  // a rounded unit quaternion's, off 1
  if (!std::isfinite(input.t_s)) return "t_s is not finite";
  if (!is_finite(vector_of(input.position_m))) return "position_m is not finite";
  const double length = length2(input.orientation_wxyz);
  if (!(length == 0.0 || std::abs(length - 1.0) < kLength2)) return "orientation_wxyz is not a unit quaternion";
  if (input.has_velocity && !is_finite(vector_of(input.velocity_m_per_s))) return "velocity_m_per_s is not finite";
  return nullptr;
}

TickInput input_of(const tangent_input& given) {
  TickInput input;
  input.t_s = given.t_s;
  input.finger.position = vector_of(given.position_m);
  const double(&q)[4] = given.orientation_wxyz;
  if (has_orientation(given)) {
    const double length = std::sqrt(length2(q));
    // As they are where they are unit: a division by 1 rounded otherwise would give other bits than the file's.
    input.finger.orientation =
        length == 1.0 ? Quat(q[0], q[1], q[2], q[3]) : Quat(q[0] / length, q[1] / length, q[2] / length, q[3] / length);
  }
  if (given.has_velocity) input.velocity = vector_of(given.velocity_m_per_s);
  return input;
}

void write_output(const TickOutput& from, uint64_t tick, double t_s, tangent_output& to) {
  to.size = sizeof(tangent_output);
  to.status = static_cast<int32_t>(from.status);
  to.tick = tick;
  to.t_s = t_s;
  to.triangle = from.triangle == kNone ? -1 : static_cast<int32_t>(from.triangle);
  to.event = static_cast<int32_t>(from.event);
  to.u = from.u, to.v = from.v;
  copy_vector(from.contact, to.contact_m), copy_vector(from.normal, to.normal);
  to.penetration_m = from.penetration_m;
  copy_vector(from.force_n, to.force_n);
  to.cld_m = from.cld_m;
  to.error_m = from.error_m;
  to.iterations = from.iterations, to.triangle_changes = from.triangle_changes;
  copy_vector(from.decided_force_n, to.decided_force_n);
  to.decided_cld_m = from.decided_cld_m;
  to.searching = from.searching ? 1 : 0;
  to.reserved = 0;
}

/// Without allocating: a servo meets this in the middle of its work.
template <class Handle>
tangent_status refuse_pose(Handle& handle, std::size_t pose, const char* fault) {
  std::array<char, 160> text{};
  const int length = std::snprintf(text.data(), text.size(),
                                   "pose %zu: %s; leave the pose out, or repeat the last good one", pose, fault);
  handle.error.set({text.data(), static_cast<std::size_t>(std::max(0, length))});
  return TANGENT_BAD_POSE;
}

/// Sizes and poses of a batch, and whether the scene takes the preset's finger, before anything is computed.
template <class Handle>
tangent_status check_batch(Handle& handle, const ContactScene& scene, const Preset& preset, const tangent_input* inputs,
                           const tangent_output* outputs, std::size_t count) {
  if (count > SIZE_MAX / sizeof(tangent_output))
    return fail_with(handle, {"the number of poses is negative, or more than any memory holds", "count",
                              "give the length of both arrays"});
  const FingerShape shape = preset.finger.shape;
  if (scene.planar() && shape != FingerShape::point && shape != FingerShape::sphere)
    return fail_with(handle, {"a 2D scene takes point and sphere fingers only", "finger.shape",
                              "set it to 0 (point) or 1 (sphere)"});
  if (count == 0) return TANGENT_OK;
  if (const tangent_status size = check_size(handle, inputs[0], "tangent_input"); size != TANGENT_OK) return size;
  if (const tangent_status size = check_size(handle, outputs[0], "tangent_output"); size != TANGENT_OK) return size;
  for (std::size_t i = 0; i < count; ++i)
    if (const char* fault = fault_of(inputs[i])) return refuse_pose(handle, i, fault);
  return TANGENT_OK;
}

/// Whether somebody has called tangent_cancel: then it is over, and nobody has until they call again.
tangent_status end_of(tangent_stepper& handle) {
  if (!handle.cancelled.exchange(false, std::memory_order_relaxed)) return TANGENT_OK;
  return fail_with(handle, {"cancelled", "tangent_cancel", "outputs from there on were not written"},
                   TANGENT_CANCELLED);
}

bool usable(const tangent_preset* preset) { return preset != nullptr && preset->usable; }

}  // namespace
}  // namespace tangent::c

using namespace tangent;

tangent_status tangent_make_stepper(const tangent_scene* scene, tangent_stepper** stepper) {
  if (scene == nullptr || !scene->scene) {
    if (stepper != nullptr) *stepper = nullptr;
    return TANGENT_NULL;
  }
  return c::make_handle(TANGENT_C_VERSION, stepper, [&](tangent_stepper& handle) {
    handle.stepper = std::make_unique<Stepper>(scene->scene);
    return TANGENT_OK;
  });
}

tangent_status tangent_step(tangent_stepper* stepper, const tangent_preset* preset, const tangent_input* input,
                            tangent_output* output) {
  return tangent_step_many(stepper, preset, input, output, 1);
}

tangent_status tangent_step_many(tangent_stepper* stepper, const tangent_preset* preset, const tangent_input* inputs,
                                 tangent_output* outputs, size_t count) {
  if (stepper == nullptr || !stepper->stepper || !c::usable(preset)) return TANGENT_NULL;
  if (count > 0 && (inputs == nullptr || outputs == nullptr)) return TANGENT_NULL;
  const c::Use use(*stepper);
  if (!use.mine()) return TANGENT_BUSY;
  return c::run_guarded(*stepper, [&] {
    const tangent_status checked =
        c::check_batch(*stepper, stepper->stepper->scene(), preset->preset, inputs, outputs, count);
    if (checked != TANGENT_OK) return checked;
    for (std::size_t i = 0; i < count && !stepper->cancelled.load(std::memory_order_relaxed); ++i) {
      const TickOutput out = stepper->stepper->step(preset->preset, c::input_of(inputs[i]), stepper->state);
      c::write_output(out, stepper->tick++, inputs[i].t_s, outputs[i]);
    }
    return c::end_of(*stepper);
  });
}

void tangent_cancel(tangent_stepper* stepper) {
  if (stepper != nullptr) stepper->cancelled.store(true, std::memory_order_relaxed);
}

tangent_status tangent_reset(tangent_stepper* stepper) {
  if (stepper == nullptr) return TANGENT_NULL;
  const c::Use use(*stepper);
  if (!use.mine()) return TANGENT_BUSY;
  stepper->state = TickState{};
  stepper->tick = 0;
  return TANGENT_OK;
}

const char* tangent_stepper_error(const tangent_stepper* stepper) {
  return stepper ? stepper->error.get() : tangent_status_text(TANGENT_NULL);
}

void tangent_free_stepper(tangent_stepper* stepper) { delete stepper; }

tangent_status tangent_solve_fingers(tangent_stepper* stepper, const tangent_preset* preset,
                                     const tangent_input* inputs, tangent_output* outputs, size_t fingers, size_t ticks,
                                     uint32_t threads) {
  if (stepper == nullptr || !stepper->stepper || !c::usable(preset)) return TANGENT_NULL;
  if (fingers > 0 && ticks > 0 && (inputs == nullptr || outputs == nullptr)) return TANGENT_NULL;
  const c::Use use(*stepper);
  if (!use.mine()) return TANGENT_BUSY;
  return c::run_guarded(*stepper, [&] {
    if (ticks != 0 && fingers > SIZE_MAX / ticks / sizeof(tangent_output))
      return c::fail_with(*stepper, {"fingers times ticks is more than any memory holds", "tangent_solve_fingers",
                                     "solve fewer at a time"});
    const tangent_status checked =
        c::check_batch(*stepper, stepper->stepper->scene(), preset->preset, inputs, outputs, fingers * ticks);
    if (checked != TANGENT_OK) return checked;
    for_each_finger(stepper->stepper->shared_scene(), fingers, threads, [&](Stepper& mine, std::size_t finger) {
      TickState state;
      for (std::size_t tick = 0; tick < ticks && !stepper->cancelled.load(std::memory_order_relaxed); ++tick) {
        const std::size_t i = finger * ticks + tick;
        TickInput input = c::input_of(inputs[i]);
        input.all_at_once = ticks == 1;
        const TickOutput out = mine.step(preset->preset, input, state);
        c::write_output(out, tick, inputs[i].t_s, outputs[i]);
      }
    });
    return c::end_of(*stepper);
  });
}
