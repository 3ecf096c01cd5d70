#include "workbench/experiment/feeling.h"

#include "workbench/experiment/simulated_touch.h"
#include "workbench/experiment/stimuli.h"

#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <cmath>

namespace tangent::experiment {
namespace {

constexpr std::size_t kWindow = 10;             // ticks that a jump may take
constexpr double kMargin = 0.05;                // of the arc's angle that stays untouched at either end
constexpr double kLanding = 0.25, kRest = 0.1;  // s, before and between strokes: not listened to
constexpr double kAbove = 1e-3;                 // m, where the hand begins

/// Force and display, tick by tick.
struct Felt {
  std::vector<Vec3> force_n;
  std::vector<double> display_m;
};

/// The largest of the changes over a jump's window, less that of the quietest tenth; 0 where there are none.
template <class Value, class Size>
double largest_jump(const std::vector<Value>& values, Size size) {
  if (values.size() <= kWindow) return 0.0;
  std::vector<double> changes;
  for (std::size_t i = kWindow; i < values.size(); ++i) changes.push_back(size(values[i] - values[i - kWindow]));
  const auto quiet = changes.begin() + static_cast<std::ptrdiff_t>(changes.size() / 10);
  std::nth_element(changes.begin(), quiet, changes.end());
  return *std::max_element(quiet, changes.end()) - *quiet;
}

/// The hand over an arc.
class Hand {
 public:
  Hand(const FeltArc& arc, const Discrimination& design, const FeelingHand& hand, std::uint64_t seed)
      : touch_(arc.scene, arc.preset, seed),
        finger_m_(arc.preset.finger.radius_m),
        design_(design),
        hand_(hand),
        angle_(-half_angle()) {}

  Status begin() { return touch_.begin(target(-kAbove, 0.0)); }
  void rest(double seconds) {
    for (int i = 0; i < seconds / kTouchTick_s; ++i) touch_.tick(target(hand_.press_m, 0.0));
  }
  /// To the other end.
  void stroke(Felt& felt) {
    const double to = angle_ < 0.0 ? half_angle() : -half_angle(), way = to - angle_;
    const double turn = std::copysign(hand_.speed_m_per_s / reach(hand_.press_m) * kTouchTick_s, way);
    for (double gone = 0.0; std::abs(gone) < std::abs(way); gone += turn) {
      angle_ += turn;
      const TickOutput out = touch_.tick(target(hand_.press_m, turn / kTouchTick_s));
      felt.force_n.push_back(out.force_n);
      felt.display_m.push_back(out.cld_m);
    }
  }
  double seconds() const { return touch_.seconds(); }

 private:
  double half_angle() const { return design_.angle_rad * (0.5 - kMargin); }
  double reach(double press_m) const { return design_.radius_m + finger_m_ - press_m; }
  HandTarget target(double press_m, double turn_rad_per_s) const {
    const Vec3 out(std::sin(angle_), std::cos(angle_), 0.0), along(out.y, -out.x, 0.0);
    return {reach(press_m) * out, reach(press_m) * turn_rad_per_s * along};
  }

  SimulatedTouch touch_;
  double finger_m_;
  const Discrimination& design_;
  const FeelingHand& hand_;
  double angle_;
};

}  // namespace

double normal_from(SplitMix& random) {
  return boost::math::quantile(boost::math::normal(), std::clamp(random.unit(), 1e-12, 1.0 - 1e-12));
}

Result<FeltArcs> arcs_to_feel(const Protocol& protocol) {
  auto stimuli = Stimuli::make(protocol);
  if (!stimuli) return tl::unexpected(stimuli.error());
  return [stimuli = std::make_shared<const Stimuli>(std::move(*stimuli))](const std::string& condition,
                                                                          int segments) -> Result<FeltArc> {
    auto arc = stimuli->arc(condition, segments);
    if (!arc) return tl::unexpected(arc.error());
    return FeltArc{std::move(arc->scene), arc->preset};
  };
}

FeelingHand feeling_hand(std::uint64_t participant, std::uint64_t seed) {
  SplitMix random(seed, participant);
  FeelingHand out;
  out.speed_m_per_s = 0.07 + 0.06 * random.unit();
  out.press_m = 1.5e-3 + 1.5e-3 * random.unit();
  out.force_noise_n *= std::exp(0.3 * normal_from(random));
  out.display_noise_m *= std::exp(0.3 * normal_from(random));
  return out;
}

double felt_size(const FeltJump& jump, const FeelingHand& hand) {
  return std::max(jump.force_n / hand.force_noise_n, jump.display_m / hand.display_noise_m);
}

Result<FeltJump> touch_arc(const FeltArc& arc, const Discrimination& design, const FeelingHand& hand,
                           std::uint64_t seed) {
  Hand moving(arc, design, hand, seed);
  if (Status ok = moving.begin(); !ok) return tl::unexpected(ok.error());
  FeltJump out;
  moving.rest(kLanding);
  for (int i = 0; i < 2; ++i) {
    Felt felt;
    moving.stroke(felt);
    out.force_n = std::max(out.force_n, largest_jump(felt.force_n, [](const Vec3& v) { return glm::length(v); }));
    out.display_m = std::max(out.display_m, largest_jump(felt.display_m, [](double v) { return std::abs(v); }));
    moving.rest(kRest);
  }
  out.seconds = moving.seconds();
  return out;
}

Result<FeelingComparer::Felt> FeelingComparer::feel(const std::string& condition, int segments, SplitMix& random) {
  Known& known = known_[{condition, segments}];
  const std::size_t place = random.below(kTouches);
  std::optional<FeltJump>& touch = known.touches[place];
  if (!touch) {
    if (!known.arc) {
      auto arc = arcs_(condition, segments);
      if (!arc) return tl::unexpected(arc.error());
      known.arc = std::make_shared<const FeltArc>(std::move(*arc));
    }
    auto felt = touch_arc(*known.arc, design_, hand_, SplitMix(seed_, place).next());
    if (!felt) return tl::unexpected(felt.error());
    touch = *felt;
  }
  return Felt{felt_size(*touch, hand_) + normal_from(random), touch->seconds};
}

}  // namespace tangent::experiment
