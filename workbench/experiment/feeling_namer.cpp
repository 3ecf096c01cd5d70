#include "workbench/experiment/feeling_namer.h"

#include "core/base/units.h"
#include "workbench/experiment/simulated_touch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent::experiment {
namespace {

constexpr double kBetweenForces_deg = 28.4;
constexpr double kLanding_s = 0.25, kAbove_m = 1e-3;

std::string key_of(const Stimulus& shown) {
  return shown.object + (shown.shaded ? " shaded" : "") + (shown.tactile ? " tactile" : "") +
         (shown.facing == Facing::left ? " left" : "");
}

double angle_between(const Vec3& a, const Vec3& b) {
  const bool none = a == Vec3(0.0) || b == Vec3(0.0);
  if (none) return a == b ? 0.0 : kBetweenForces_deg * kDegree;  // a push is told from none
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

double direction_noise_rad(const FeelingHand& hand) {
  const double own = hand.force_noise_n / FeelingHand{}.force_noise_n;  // from one participant to the next
  return own * kBetweenForces_deg * kDegree / 0.77;                     // as in feeling.h
}

double distance2(const FeltObject& a, const FeltObject& b, const FeelingHand& hand) {
  double sum = 0.0;
  for (std::size_t i = 0; i < FeltObject::kPieces; ++i) {
    const double turned = angle_between(a.direction[i], b.direction[i]) / direction_noise_rad(hand);
    const double moved = (a.display_m[i] - b.display_m[i]) / hand.display_noise_m;
    sum += turned * turned + moved * moved;
  }
  return sum;
}

Result<FeltObject> touch_object(const RenderedStimulus& stimulus, const StrokePath& path, const FeelingHand& hand,
                                std::uint64_t seed) {
  const double pad_m = pad_distance_m(stimulus.preset.finger);
  SimulatedTouch touch(stimulus.scene, stimulus.preset, seed,
                       stimulus.placement.orientation_to_scene(Quat(1.0, 0.0, 0.0, 0.0)));
  if (Status ok = touch.begin({path.at(0.0, pad_m, -kAbove_m).position_m}); !ok) return tl::unexpected(ok.error());
  const HandTarget start{path.at(0.0, pad_m, hand.press_m).position_m};
  for (int i = 0; i < kLanding_s / kTouchTick_s; ++i) touch.tick(start);
  FeltObject out;
  const double step_m = hand.speed_m_per_s * kTouchTick_s;
  const auto ticks = static_cast<std::size_t>(path.length_m() / step_m);
  std::array<double, FeltObject::kPieces> counts{};
  Vec3 before = start.position_m;
  for (std::size_t i = 0; i < ticks; ++i) {
    const Vec3 at = path.at(static_cast<double>(i) * step_m, pad_m, hand.press_m).position_m;
    const TickOutput tick = touch.tick({at, (at - before) / kTouchTick_s});
    before = at;
    const std::size_t piece = i * FeltObject::kPieces / ticks;
    out.direction[piece] += tick.force_n;
    out.display_m[piece] += tick.cld_m;
    counts[piece] += 1.0;
    if (tick.force_n != Vec3(0.0)) out.touching_s += kTouchTick_s;
  }
  for (std::size_t i = 0; i < FeltObject::kPieces; ++i) {
    const double size = glm::length(out.direction[i]);
    out.direction[i] = size > 0.0 ? out.direction[i] / size : Vec3(0.0);
    out.display_m[i] /= std::max(1.0, counts[i]);
  }
  out.seconds = touch.seconds();
  return out;
}

Result<FeelingNamer> FeelingNamer::make(const Protocol& protocol, const FeelingHand& hand, std::uint64_t seed) {
  auto stimuli = Stimuli::make(protocol);
  if (!stimuli) return tl::unexpected(stimuli.error());
  return FeelingNamer(std::move(*stimuli), *protocol.identification(), hand, seed);
}

Result<const FeltObject*> FeelingNamer::felt(const Stimulus& shown, std::size_t place) {
  const auto at = known_.find({key_of(shown), place});
  if (at != known_.end()) return &at->second;
  const auto stimulus = stimuli_.rendered(shown);
  if (!stimulus) return tl::unexpected(stimulus.error());
  auto path = paths_.find(stimulus->mesh_hash);
  if (path == paths_.end()) {
    auto built = StrokePath::build(*stimulus->scene, pad_distance_m(stimulus->preset.finger));
    if (!built) return tl::unexpected(built.error());
    path = paths_.emplace(stimulus->mesh_hash, std::move(*built)).first;
  }
  auto felt = touch_object(*stimulus, path->second, hand_, SplitMix(seed_, place).next());
  if (!felt) return tl::unexpected(felt.error());
  return &known_.emplace(std::pair(key_of(shown), place), std::move(*felt)).first->second;
}

// Of the direction, two turns about axes across it.
FeltObject FeelingNamer::with_noise(const FeltObject& felt, SplitMix& random) const {
  FeltObject out = felt;
  for (std::size_t i = 0; i < FeltObject::kPieces; ++i) {
    Vec3& direction = out.direction[i];
    if (direction != Vec3(0.0)) {
      const Vec3 other = std::abs(direction.z) < 0.9 ? Vec3(0.0, 0.0, 1.0) : Vec3(1.0, 0.0, 0.0);
      const Vec3 across = glm::normalize(glm::cross(direction, other)), third = glm::cross(direction, across);
      const double turn = direction_noise_rad(hand_) / std::sqrt(2.0);
      const double first = turn * normal_from(random), second = turn * normal_from(random);
      direction = glm::normalize(direction + std::tan(std::clamp(first, -1.5, 1.5)) * across +
                                 std::tan(std::clamp(second, -1.5, 1.5)) * third);
    }
    out.display_m[i] += hand_.display_noise_m * normal_from(random);
  }
  return out;
}

Result<FeelingNamer::Named> FeelingNamer::name(const Stimulus& shown, SplitMix& random) {
  const auto touched = felt(shown, 1 + random.below(kTouches));
  if (!touched) return tl::unexpected(touched.error());
  const FeltObject now = with_noise(**touched, random);
  Named out{0, (*touched)->seconds, (*touched)->touching_s};
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < design_.objects.size(); ++i) {
    const bool both =
        std::find(design_.both_ways.begin(), design_.both_ways.end(), design_.objects[i]) != design_.both_ways.end();
    for (const bool shaded : {true, false})
      for (const Facing facing : {Facing::right, Facing::left}) {
        if (facing == Facing::left && !both) continue;
        Stimulus remembered = shown;
        remembered.object = design_.objects[i];
        remembered.shaded = shaded;
        remembered.facing = facing;
        const auto known = felt(remembered, 0);
        if (!known) return tl::unexpected(known.error());
        const double distance = distance2(now, **known, hand_);
        if (distance < nearest) out.answer = i, nearest = distance;
      }
  }
  return out;
}

}  // namespace tangent::experiment
