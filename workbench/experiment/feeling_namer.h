// A simulated participant who feels and names objects: the simulated hand strokes the object as the paper's
// participants did (5.3.2, 5.3.7: left and right over its top, then forward and back), and all that is known of it is
// the force and the display that the ticks render. The way is cut into sixteen pieces of the same length; of each, the
// mean direction of force and the mean place of the display count. The object is the one whose remembered pieces are
// the nearest, shaded or not, facing either way, each difference in units of a person's own noise:
//   force    28.4 degrees between forces one after the other (Barbagli et al. 2006, as the paper has it, 5.2.6)
//   display  as in feeling.h
// What is remembered was felt before, without noise, under the same feedback. That is an ideal observer but for its
// noise and for what the pieces leave out; nothing is fitted to the paper's tables.
#pragma once

#include "workbench/experiment/feeling.h"
#include "workbench/experiment/stimuli.h"
#include "workbench/session/stroke_path.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tangent::experiment {

/// What is felt of one object.
struct FeltObject {
  static constexpr std::size_t kPieces = 16;
  std::array<Vec3, kPieces> direction{};    ///< unit, of the mean force; zero: nothing pushed
  std::array<double, kPieces> display_m{};  ///< mean
  double seconds = 0.0, touching_s = 0.0;   ///< that the touch took; with a force
};

/// Strokes once around, along a path over this object for this finger. Fails as the device does. Deterministic.
Result<FeltObject> touch_object(const RenderedStimulus& stimulus, const StrokePath& path, const FeelingHand& hand,
                                std::uint64_t seed);

/// Direction noise of a person, rad; that of the display is FeelingHand's.
double direction_noise_rad(const FeelingHand& hand);
/// Squared distance in units of the noise.
double distance2(const FeltObject& a, const FeltObject& b, const FeelingHand& hand);

class FeelingNamer {
 public:
  /// Of a protocol's objects. Fails as Stimuli::make does.
  static Result<FeelingNamer> make(const Protocol& protocol, const FeelingHand& hand, std::uint64_t seed);

  struct Named {
    std::size_t answer = 0;  ///< of Identification::objects
    double seconds = 0.0, touching_s = 0.0;
  };
  /// `random`: of this trial.
  Result<Named> name(const Stimulus& shown, SplitMix& random);

 private:
  FeelingNamer(Stimuli stimuli, const Identification& design, const FeelingHand& hand, std::uint64_t seed)
      : stimuli_(std::move(stimuli)), design_(design), hand_(hand), seed_(seed) {}
  /// `place` 0: what is remembered, others: touches of trials.
  Result<const FeltObject*> felt(const Stimulus& shown, std::size_t place);
  FeltObject with_noise(const FeltObject& felt, SplitMix& random) const;

  static constexpr std::size_t kTouches = 2;  ///< of each stimulus, felt again later with new noise
  Stimuli stimuli_;
  Identification design_;
  FeelingHand hand_;
  std::uint64_t seed_;
  std::map<std::string, StrokePath> paths_;                          ///< by mesh: those of large ones take long
  std::map<std::pair<std::string, std::size_t>, FeltObject> known_;  ///< by stimulus, and which touch
};

}  // namespace tangent::experiment
