#include "workbench/recording/tick_columns.h"

#include <array>
#include <bit>
#include <limits>
#include <type_traits>
#include <utility>

namespace tangent {
namespace {

using Tick = RecordedTick;
using enum ColumnOf;

TickInput& input_of(Tick& t) { return t.record.tick.input; }
TickOutput& output_of(Tick& t) { return t.record.tick.output; }
DeviceTelemetry& device_of(Tick& t) { return t.record.device; }

constexpr std::array kReal{
    RealColumn{"t_s", input, "time of the tick", [](Tick& t) -> double& { return input_of(t).t_s; }},
    RealColumn{"finger_x_m", input, "finger's centre, world",
               [](Tick& t) -> double& { return input_of(t).finger.position.x; }},
    RealColumn{"finger_y_m", input, "", [](Tick& t) -> double& { return input_of(t).finger.position.y; }},
    RealColumn{"finger_z_m", input, "", [](Tick& t) -> double& { return input_of(t).finger.position.z; }},
    RealColumn{"finger_qw", input, "finger frame to world, unit quaternion",
               [](Tick& t) -> double& { return input_of(t).finger.orientation.w; }},
    RealColumn{"finger_qx", input, "", [](Tick& t) -> double& { return input_of(t).finger.orientation.x; }},
    RealColumn{"finger_qy", input, "", [](Tick& t) -> double& { return input_of(t).finger.orientation.y; }},
    RealColumn{"finger_qz", input, "", [](Tick& t) -> double& { return input_of(t).finger.orientation.z; }},
    RealColumn{"finger_vx_m_per_s",
               input,
               "finger's velocity where the device measures it, else NULL",
               [](Tick& t) -> double& { return t.velocity.x; },
               nullptr,
               {},
               true},
    RealColumn{"finger_vy_m_per_s", input, "", [](Tick& t) -> double& { return t.velocity.y; }, nullptr, {}, true},
    RealColumn{"finger_vz_m_per_s", input, "", [](Tick& t) -> double& { return t.velocity.z; }, nullptr, {}, true},
    RealColumn{"u", output, "barycentric weight of the triangle's 2nd corner",
               [](Tick& t) -> double& { return output_of(t).u; }},
    RealColumn{"v", output, "and of its 3rd", [](Tick& t) -> double& { return output_of(t).v; }},
    RealColumn{"contact_x_m", output, "where the tangent plane touches the surface, world",
               [](Tick& t) -> double& { return output_of(t).contact.x; }},
    RealColumn{"contact_y_m", output, "", [](Tick& t) -> double& { return output_of(t).contact.y; }},
    RealColumn{"contact_z_m", output, "", [](Tick& t) -> double& { return output_of(t).contact.z; }},
    RealColumn{"normal_x", output, "its unit normal", [](Tick& t) -> double& { return output_of(t).normal.x; }},
    RealColumn{"normal_y", output, "", [](Tick& t) -> double& { return output_of(t).normal.y; }},
    RealColumn{"normal_z", output, "", [](Tick& t) -> double& { return output_of(t).normal.z; }},
    RealColumn{"penetration_m", output, "finger radius minus height over the plane",
               [](Tick& t) -> double& { return output_of(t).penetration_m; }},
    RealColumn{"force_x_n", output, "force on the finger, as computed",
               [](Tick& t) -> double& { return output_of(t).force_n.x; }},
    RealColumn{"force_y_n", output, "", [](Tick& t) -> double& { return output_of(t).force_n.y; }},
    RealColumn{"force_z_n", output, "", [](Tick& t) -> double& { return output_of(t).force_n.z; }},
    RealColumn{"cld_m", output, "position of the contact location display, as computed",
               [](Tick& t) -> double& { return output_of(t).cld_m; }},
    RealColumn{"error_m", output, "between the surface point and the finger's contact on the plane there",
               [](Tick& t) -> double& { return output_of(t).error_m; }},
    RealColumn{"decided_force_x_n", output, "force before the fade; NULL: as force_x_n",
               [](Tick& t) -> double& { return output_of(t).decided_force_n.x; },
               [](Tick& t) -> double& { return output_of(t).force_n.x; }, "force_x_n"},
    RealColumn{"decided_force_y_n", output, "", [](Tick& t) -> double& { return output_of(t).decided_force_n.y; },
               [](Tick& t) -> double& { return output_of(t).force_n.y; }, "force_y_n"},
    RealColumn{"decided_force_z_n", output, "", [](Tick& t) -> double& { return output_of(t).decided_force_n.z; },
               [](Tick& t) -> double& { return output_of(t).force_n.z; }, "force_z_n"},
    RealColumn{"decided_cld_m", output, "display before the fade; NULL: as cld_m",
               [](Tick& t) -> double& { return output_of(t).decided_cld_m; },
               [](Tick& t) -> double& { return output_of(t).cld_m; }, "cld_m"},
    RealColumn{"way_out_x_m", output, "out of several places at once, which the force comes from; 0: of one",
               [](Tick& t) -> double& { return output_of(t).way_out_m.x; }},
    RealColumn{"way_out_y_m", output, "", [](Tick& t) -> double& { return output_of(t).way_out_m.y; }},
    RealColumn{"way_out_z_m", output, "", [](Tick& t) -> double& { return output_of(t).way_out_m.z; }},
    RealColumn{"solve_ns", timing, "wall-clock time of the solver's step",
               [](Tick& t) -> double& { return t.record.tick.solve_ns; }},
    RealColumn{"tick_ns", timing, "of the whole tick: devices, step, gate",
               [](Tick& t) -> double& { return t.record.tick_ns; }},
    RealColumn{"period_ns", timing, "from the start of the last tick",
               [](Tick& t) -> double& { return t.record.period_ns; }},
    RealColumn{"lateness_ns", timing, "start minus deadline", [](Tick& t) -> double& { return t.record.lateness_ns; }},
    RealColumn{"latency_ns", timing, "age of the position in the command that was sent",
               [](Tick& t) -> double& { return t.record.latency_ns; }},
    RealColumn{"command_force_x_n", device, "force after the safety gate; NULL: as force_x_n",
               [](Tick& t) -> double& { return device_of(t).force_command_n.x; },
               [](Tick& t) -> double& { return output_of(t).force_n.x; }, "force_x_n"},
    RealColumn{"command_force_y_n", device, "", [](Tick& t) -> double& { return device_of(t).force_command_n.y; },
               [](Tick& t) -> double& { return output_of(t).force_n.y; }, "force_y_n"},
    RealColumn{"command_force_z_n", device, "", [](Tick& t) -> double& { return device_of(t).force_command_n.z; },
               [](Tick& t) -> double& { return output_of(t).force_n.z; }, "force_z_n"},
    RealColumn{"command_cld_m", device, "display's target after the safety gate; NULL: as cld_m",
               [](Tick& t) -> double& { return device_of(t).cld_command_m; },
               [](Tick& t) -> double& { return output_of(t).cld_m; }, "cld_m"},
    RealColumn{"device_force_x_n", device, "force that the device applied while this position was measured",
               [](Tick& t) -> double& { return device_of(t).force_rendered_n.x; }},
    RealColumn{"device_force_y_n", device, "", [](Tick& t) -> double& { return device_of(t).force_rendered_n.y; }},
    RealColumn{"device_force_z_n", device, "", [](Tick& t) -> double& { return device_of(t).force_rendered_n.z; }},
    RealColumn{"device_cld_m", device, "roller's position, as measured",
               [](Tick& t) -> double& { return device_of(t).cld_measured_m; }},
    RealColumn{"hand_x_m", device, "where the simulated hand aims",
               [](Tick& t) -> double& { return device_of(t).hand_target_m.x; }},
    RealColumn{"hand_y_m", device, "", [](Tick& t) -> double& { return device_of(t).hand_target_m.y; }},
    RealColumn{"hand_z_m", device, "", [](Tick& t) -> double& { return device_of(t).hand_target_m.z; }},
    RealColumn{"force_age_s", device, "age of the finger's position",
               [](Tick& t) -> double& { return device_of(t).force_age_s; }},
    RealColumn{"display_age_s", device, "age of the roller's position",
               [](Tick& t) -> double& { return device_of(t).display_age_s; }},
    RealColumn{"energy_j", device, "> 0 made by the loop, < 0 stored by the hand",
               [](Tick& t) -> double& { return device_of(t).energy_j; }},
};
static_assert(kReal.size() <= 64);  // a bit for each while a row is read

constexpr std::int64_t kMost32 = std::numeric_limits<std::uint32_t>::max();
constexpr std::int64_t kMostInt = std::numeric_limits<std::int32_t>::max();

template <class E>
constexpr std::int64_t code_of(E e) {
  return static_cast<std::int64_t>(e);
}
template <class E>
constexpr const char* word_of(std::int64_t code) {
  return to_string(static_cast<E>(code));
}

constexpr std::array kWhole{
    WholeColumn{"preset_id", input, "row of presets", 0, kMost32,
                [](const Tick& t) { return std::int64_t{t.record.tick.preset_id}; },
                [](Tick& t, std::int64_t v) { t.record.tick.preset_id = static_cast<std::uint32_t>(v); }},
    WholeColumn{"scene_id", input, "row of scenes", 0, kMost32,
                [](const Tick& t) { return std::int64_t{t.record.scene_id}; },
                [](Tick& t, std::int64_t v) { t.record.scene_id = static_cast<std::uint32_t>(v); }},
    WholeColumn{"status", output, "free, face, edge, vertex, unconverged, facing", 0, code_of(TickStatus::facing),
                [](const Tick& t) { return code_of(t.record.tick.output.status); },
                [](Tick& t, std::int64_t v) { t.record.tick.output.status = static_cast<TickStatus>(v); },
                &word_of<TickStatus>},
    WholeColumn{"event", output, "none, first, reseed, switch, branch", 0, code_of(TickEvent::branch),
                [](const Tick& t) { return code_of(t.record.tick.output.event); },
                [](Tick& t, std::int64_t v) { t.record.tick.output.event = static_cast<TickEvent>(v); },
                &word_of<TickEvent>},
    WholeColumn{
        "triangle", output, "fan triangle of the file's faces, from 0; -1: nothing is tracked", -1, kMost32 - 1,
        [](const Tick& t) {
          const std::uint32_t triangle = t.record.tick.output.triangle;
          return triangle == kNone ? std::int64_t{-1} : std::int64_t{triangle};
        },
        [](Tick& t, std::int64_t v) { t.record.tick.output.triangle = v < 0 ? kNone : static_cast<std::uint32_t>(v); }},
    WholeColumn{"iterations", output, "tangent planes computed in the tick", -kMostInt, kMostInt,
                [](const Tick& t) { return std::int64_t{t.record.tick.output.iterations}; },
                [](Tick& t, std::int64_t v) { t.record.tick.output.iterations = static_cast<std::int32_t>(v); }},
    WholeColumn{"triangle_changes", output, "edges crossed", -kMostInt, kMostInt,
                [](const Tick& t) { return std::int64_t{t.record.tick.output.triangle_changes}; },
                [](Tick& t, std::int64_t v) { t.record.tick.output.triangle_changes = static_cast<std::int32_t>(v); }},
    WholeColumn{"missed_deadlines", timing, "deadlines skipped before this tick", 0, kMost32,
                [](const Tick& t) { return std::int64_t{t.record.missed_deadlines}; },
                [](Tick& t, std::int64_t v) { t.record.missed_deadlines = static_cast<std::uint32_t>(v); }},
    WholeColumn{"unready", input, "1: what it would search was not built yet, so it did not search", 0, 1,
                [](const Tick& t) { return std::int64_t{t.record.tick.input.unready}; },
                [](Tick& t, std::int64_t v) { t.record.tick.input.unready = v != 0; }},
    WholeColumn{"searching", output, "1: the search for deeper places goes on at the next tick", 0, 1,
                [](const Tick& t) { return std::int64_t{t.record.tick.output.searching}; },
                [](Tick& t, std::int64_t v) { t.record.tick.output.searching = v != 0; }},
};

/// A state of a device: an enumeration of 8 bits.
template <auto Field, auto Last>
constexpr WholeColumn state_column(std::string_view name, std::string_view meaning) {
  using E = decltype(Last);
  return {name,
          device,
          meaning,
          0,
          code_of(Last),
          [](const Tick& t) { return code_of(t.record.device.*Field); },
          [](Tick& t, std::int64_t v) { t.record.device.*Field = static_cast<E>(v); },
          &word_of<E>};
}

template <auto Field>
constexpr WholeColumn bits_column(std::string_view name, std::string_view meaning, std::int64_t most) {
  return {name,
          device,
          meaning,
          0,
          most,
          [](const Tick& t) { return static_cast<std::int64_t>(t.record.device.*Field); },
          [](Tick& t, std::int64_t v) {
            using T = std::remove_reference_t<decltype(t.record.device.*Field)>;
            t.record.device.*Field = static_cast<T>(v);
          }};
}

using D = DeviceTelemetry;
constexpr std::array kDevice{
    state_column<&D::force_state, DeviceState::faulted>("force_state", "of the force device"),
    state_column<&D::force_fault, DeviceFault::watchdog>("force_fault", ""),
    state_column<&D::display_state, DeviceState::faulted>("display_state", "of the contact location display"),
    state_column<&D::display_fault, DeviceFault::watchdog>("display_fault", ""),
    state_column<&D::gate_state, GateState::faulted>("gate_state", "of the safety gate"),
    state_column<&D::gate_fault, GateFault::exchange_hung>("gate_fault", ""),
    bits_column<&D::gate_actions>("gate_actions", "what the gate limited: a bit each", 0xffff),
    state_column<&D::arming, ArmingStage::given_up>("arming", "how far arming has come"),
    state_column<&D::in_the_way, ArmingObstacle::finger_at_depth>("in_the_way", "of arming"),
    bits_column<&D::hand_led>("hand_led", "1: a simulated hand leads the finger", 1),
    bits_column<&D::buttons>("buttons", "pressed on the device: a bit each", kMost32),
};

/// Order matters, and so does every bit.
class Digest {
 public:
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x9e3779b97f4a7c15ull;
    value_ ^= value_ >> 32;
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(const Vec3& v) {
    add(v.x);
    add(v.y);
    add(v.z);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

}  // namespace

RecordedTick recorded_tick(const ServoRecord& record) {
  return {record, record.tick.input.velocity.value_or(Vec3(0.0)), record.tick.input.velocity.has_value(),
          output_digest(record.tick.output)};
}

std::span<const RealColumn> real_columns() { return kReal; }
std::span<const WholeColumn> whole_columns() { return kWhole; }
std::span<const WholeColumn> device_columns() { return kDevice; }

std::string unit_of(std::string_view column) {
  constexpr std::pair<std::string_view, std::string_view> kUnits[]{{"_m_per_s", "m/s"}, {"_m", "m"}, {"_n", "N"},
                                                                   {"_ns", "ns"},       {"_s", "s"}, {"_j", "J"}};
  for (const auto& [ending, unit] : kUnits)
    if (column.ends_with(ending)) return std::string(unit);
  return "1";
}

std::uint64_t output_digest(const TickOutput& output) {
  Digest digest;
  digest.add(static_cast<std::uint64_t>(output.status) | static_cast<std::uint64_t>(output.event) << 8 |
             static_cast<std::uint64_t>(output.searching) << 16 | std::uint64_t{output.triangle} << 32);
  digest.add(static_cast<std::uint64_t>(static_cast<std::uint32_t>(output.iterations)) |
             static_cast<std::uint64_t>(static_cast<std::uint32_t>(output.triangle_changes)) << 32);
  digest.add(output.u);
  digest.add(output.v);
  digest.add(output.contact);
  digest.add(output.normal);
  digest.add(output.penetration_m);
  digest.add(output.force_n);
  digest.add(output.cld_m);
  digest.add(output.error_m);
  digest.add(output.decided_force_n);
  digest.add(output.decided_cld_m);
  digest.add(output.way_out_m);
  return digest.value();
}

}  // namespace tangent
