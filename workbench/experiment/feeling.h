// A simulated participant who feels: the simulated hand strokes the stimulus, there and back, under the program's own
// ticks, and all that is known of the stimulus is the force and the display that they render. What counts is the
// largest jump met. Whichever of two has the larger one is taken for the polygon.
//
// A jump is how far force, or display, comes within 10 ms, less how far it comes in the quietest tenth of the stroke,
// so that the steady turn of a smooth arc is none. Jumps count in units of a person's own noise, the larger of the two
// is felt, and normal noise of one unit is added to each stimulus. So that one of two is told from none in 70.7 % at
// the threshold, the noise is the threshold over 0.77:
//   force    20.8 mN, found by a staircase to 71 % (Lee & Hannaford 2003, eleven people)
//   display  0.1 mm: a point's shift on the skin is told at a tenth to a thirtieth of the two-point limen (Loomis &
//            Collins 1978), which is some 2 mm at the fingertip
// Nothing is fitted to the paper's tables. Encoder steps, friction and tremor are the simulated device's own. One who
// names objects: feeling_namer.h.
#pragma once

#include "core/base/result.h"
#include "core/base/split_mix.h"
#include "core/tick/step.h"
#include "workbench/experiment/protocol.h"

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tangent::experiment {

/// An arc as ticks need it.
struct FeltArc {
  std::shared_ptr<const ContactScene> scene;
  Preset preset;
};
/// By condition and segments; 0: the exact arc.
using FeltArcs = std::function<Result<FeltArc>(const std::string& condition, int segments)>;
/// Of a protocol's arcs, in the circle's own frame. Fails where they can't be built (stimuli.h).
Result<FeltArcs> arcs_to_feel(const Protocol& protocol);

/// What differs from one participant to the next.
struct FeelingHand {
  double speed_m_per_s = 0.1;
  double press_m = 2.25e-3;  ///< of the hand's target under the surface
  double force_noise_n = 0.0208 / 0.77, display_noise_m = 1e-4 / 0.77;
};
/// Speeds of 70 to 130 mm/s, 1.5 to 3 mm under the surface, noise that varies by a third.
FeelingHand feeling_hand(std::uint64_t participant, std::uint64_t seed);

/// A standard normal value.
double normal_from(SplitMix& random);

/// The largest jumps of a touch.
struct FeltJump {
  double force_n = 0.0, display_m = 0.0;
  double seconds = 0.0;  ///< that the touch took
};
/// In units of the participant's noise: the larger of the two.
double felt_size(const FeltJump& jump, const FeelingHand& hand);

/// One touch: the hand comes down at the left end, strokes to the right end and back. Deterministic.
Result<FeltJump> touch_arc(const FeltArc& arc, const Discrimination& design, const FeelingHand& hand,
                           std::uint64_t seed);

/// One participant. Each stimulus is touched a few times, with other tremor each; later on one of these touches is felt
/// again, with new noise: the answers are the same in whichever order they are asked for.
class FeelingComparer {
 public:
  FeelingComparer(FeltArcs arcs, const Discrimination& design, const FeelingHand& hand, std::uint64_t seed)
      : arcs_(std::move(arcs)), design_(design), hand_(hand), seed_(seed) {}

  struct Felt {
    double size = 0.0;  ///< with noise
    double seconds = 0.0;
  };
  Result<Felt> feel(const std::string& condition, int segments, SplitMix& random);

 private:
  static constexpr std::size_t kTouches = 6;
  FeltArcs arcs_;
  Discrimination design_;
  FeelingHand hand_;
  std::uint64_t seed_;
  struct Known {
    std::shared_ptr<const FeltArc> arc;
    std::array<std::optional<FeltJump>, kTouches> touches;
  };
  std::map<std::pair<std::string, int>, Known> known_;
};

}  // namespace tangent::experiment
