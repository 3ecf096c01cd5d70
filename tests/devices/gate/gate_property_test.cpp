// Random sequences through the safety gate: rates, gaps, forces, faults, arming, all of them at any moment. What must
// hold whatever comes is checked at every tick; rapidcheck makes a sequence that fails as short as it can.
// TANGENT_SEQUENCES=N runs N of them; a failure says how to repeat it (RC_PARAMS).
#include "devices/safety_gate.h"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

using namespace tangent;

namespace {

int sequences() {
  if (const char* wanted = std::getenv("TANGENT_SEQUENCES")) return std::max(1, std::atoi(wanted));
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(NDEBUG)
  return 10'000;
#else
  return 200'000;
#endif
}

/// What happens, decoded from a number: a kind and two arguments, so that a smaller number is a simpler event.
struct GateEvent {
  unsigned kind, a, b;
  explicit GateEvent(std::uint32_t bits) : kind(bits % 24), a(bits / 24 % 256), b(bits / 6144 % 256) {}
  double share() const { return a / 255.0; }
  double other() const { return b / 255.0; }
};

constexpr double kOdd[]{std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity(),
                        -std::numeric_limits<double>::infinity(),
                        1e300,
                        -1e300,
                        0.0};

/// The gate with what it is told, and what it must never do.
class GateUnderTest {
 public:
  explicit GateUnderTest(std::uint32_t setup) : limits_(limits_of(setup)), gate_(limits_) {
    input_.force_device = input_.display = DeviceState::ready;
    input_.display_measures = setup % 2 == 0;
    input_.stiffness_n_per_m = 1000.0;
  }

  /// Empty: nothing wrong.
  std::string apply(const GateEvent& event) {
    armed_now_ = false;
    double dt = limits_.period_s;
    switch (event.kind) {
      case 0:
        break;
      case 1:
        gate_.arm();
        armed_now_ = true;
        break;
      case 2:
        gate_.stop();
        break;
      case 3:
        gate_.restart_ramp();
        break;
      case 4:
        dt *= 1.0 + event.a % 30;
        break;
      case 5:
        dt *= 0.01 + event.share();
        break;
      case 6:
        input_.force_n = Vec3(12.0 * event.share(), -9.0 * event.other(), 20.0 * event.share() * event.other());
        break;
      case 7:
        input_.force_n[static_cast<int>(event.a % 3)] = kOdd[event.b % 6];
        break;
      case 8:
        input_.force_n = Vec3(0.0, 0.0, event.share());
        break;
      case 9:
        input_.display_m = 30e-3 * (event.share() - 0.5);
        break;
      case 10:
        input_.display_m = kOdd[event.a % 6];
        break;
      case 11:
        input_.force_device = static_cast<DeviceState>(event.a % 6);
        break;
      case 12:
        input_.display = static_cast<DeviceState>(event.a % 6);
        break;
      case 13:
        input_.force_device = input_.display = DeviceState::ready;
        break;
      case 14:
        input_.position_m += 1e-3 * Vec3(event.share() - 0.5, event.other() - 0.5, event.share());
        break;
      case 15:
        input_.position_m = Vec3(0.2 * event.share(), 0.2 * event.other(), 0.0);
        break;
      case 16:
        input_.position_m[static_cast<int>(event.a % 3)] = kOdd[event.b % 6];
        break;
      case 17:
        input_.position_age_s = 15e-3 * event.share();
        break;
      case 18:
        (event.a % 2 == 0 ? input_.position_age_s : input_.display_age_s) = event.b % 2 == 0 ? -1e-3 : kOdd[0];
        break;
      case 19:
        input_.position_age_s = input_.display_age_s = 0.0;
        break;
      case 20:
        input_.display_measured_m = 20e-3 * (event.share() - 0.5);
        break;
      case 21:
        input_.stiffness_n_per_m = event.b % 8 == 0 ? kOdd[event.a % 6] : 5000.0 * event.share();
        input_.declared_j = event.b % 16 == 1 ? kOdd[event.a % 6] : 1e-3 * event.other();
        input_.elastic_n = event.b % 16 == 2 ? kOdd[event.a % 6] : 20.0 * event.other();
        break;
      case 22:
        input_.display_lowest_m = -0.02 * event.share();
        input_.display_highest_m = 0.02 * event.other();
        break;
      default:
        input_ = GateInput{.force_n = Vec3(0, 0, 2),
                           .force_device = DeviceState::ready,
                           .display = DeviceState::ready,
                           .stiffness_n_per_m = 1000.0};
    }
    // Every event is followed by ticks, so that short sequences reach far.
    std::string wrong = tick(dt);
    armed_now_ = false;
    for (unsigned i = 0; i < event.b % 8 && wrong.empty(); ++i) wrong = tick(limits_.period_s);
    return wrong;
  }

 private:
  static GateLimits limits_of(std::uint32_t setup) {
    constexpr double rates[]{1000.0, 100.0, 10'000.0, 333.0};
    GateLimits l;
    l.period_s = 1.0 / rates[setup % 4];
    l.peak_force_n = setup / 4 % 4 == 3 ? 0.0 : 8.5;
    l.continuous_force_n = setup / 16 % 2 == 0 ? 0.0 : std::min(1.4, l.peak_force_n);
    l.ramp_s = setup / 32 % 2 == 0 ? 0.0 : 20e-3;
    l.display_travel_m = 20e-3;
    l.workspace_half_size_m = Vec3(setup / 64 % 2 == 0 ? 0.0 : 0.1);
    l.fastest_target_m_per_s = 0.25;
    return l;
  }
  static double size(const Vec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }
  bool live() const { return gate_.state() == GateState::ramping || gate_.state() == GateState::armed; }

  std::string tick(double dt) {
    const bool was_live = live_before_;
    const Vec3 sent = gate_.before_sending(dt);
    if (!is_finite(sent)) return "what is sent is not finite";
    if (size(sent) > limits_.peak_force_n) return "more than the peak is sent";
    if (sent != Vec3(0.0) && sent != passed_) return "something is sent that did not pass";
    if (!live() && sent != Vec3(0.0) && (stopped_ticks_ > 1 || gate_.fault() != GateFault::stale_sample))
      return "a force is sent while stopped";
    const GateOutput out = gate_.pass(input_, dt);
    if (live() && !was_live && !armed_now_) return "it armed by itself";
    if (!is_finite(out.force_n) || !std::isfinite(out.display_m)) return "what passes is not finite";
    if (size(out.force_n) > limits_.peak_force_n) return "more than the peak passes";
    const double change = size(out.force_n - sent), slew = limits_.slew_n_per_s * limits_.period_s;
    if (live() && change > slew * (1.0 + 1e-9)) return "the force changed too fast";
    stopped_ticks_ = live() ? 0 : stopped_ticks_ + 1;
    if (!live() && size(out.force_n) > 0.5 * size(sent) * (1.0 + 1e-12)) return "more than half passes while stopped";
    if (stopped_ticks_ > 1 && out.force_n != Vec3(0.0)) return "a force passes two ticks after a stop";
    if (input_.force_device != DeviceState::ready && out.force_n != Vec3(0.0)) return "a force for a device not ready";
    if (std::abs(out.display_m) > 10e-3) return "the display is beyond its travel";
    if (std::abs(out.display_m - display_) > 0.25 * limits_.period_s * (1.0 + 1e-9)) return "the display is too fast";
    const double full = (8.5 * 8.5 - 1.4 * 1.4) * ForceBudget::kPeakHold_s;
    if (!(gate_.heat().store_n2s() >= 0.0 && gate_.heat().store_n2s() <= full)) return "the heat is not bounded";
    const EnergyWatch& energy = gate_.energy();
    if (!std::isfinite(energy.net_j()) || energy.credit_j() < 0.0) return "the energy is not bounded";
    passed_ = out.force_n;
    display_ = out.display_m;
    live_before_ = live();
    return {};
  }

  GateLimits limits_;
  SafetyGate gate_;
  GateInput input_;
  Vec3 passed_{0.0};
  double display_ = 0.0;
  bool live_before_ = false, armed_now_ = false;
  int stopped_ticks_ = 0;
};

}  // namespace

TEST_CASE(
    "whatever comes, in any order, the gate keeps its limits, sends nothing while stopped and never arms itself") {
  const int wanted = sequences();
  std::uint64_t events = 0;
  const auto property = [&events](std::uint32_t setup, const std::vector<std::uint32_t>& sequence) {
    GateUnderTest gate(setup);
    // Armed from the start in most, so that there is something to stop.
    std::string wrong = setup % 8 == 7 ? std::string() : gate.apply(GateEvent(1));
    for (std::size_t i = 0; i < sequence.size() && wrong.empty(); ++i) wrong = gate.apply(GateEvent(sequence[i]));
    events += sequence.size();
    if (!wrong.empty()) RC_FAIL(wrong);
  };
  rc::detail::TestParams params = rc::detail::configuration().testParams;
  params.maxSuccess = wanted;
  params.maxSize = 60;
  if (std::getenv("TANGENT_SEQUENCES") == nullptr) params.seed = 1;  // the same every time, unless more are asked for
  rc::detail::TestMetadata about;
  about.description = "gate";
  const auto result = rc::detail::checkTestable(property, about, params);
  std::ostringstream said;
  rc::detail::printResultMessage(result, said);
  MESSAGE(events << " events in " << wanted << " sequences");
  const bool held = result.template is<rc::detail::SuccessResult>();
  CHECK_MESSAGE(held, said.str());
}
