// What a protocol can put before the finger, ready to be rendered: scene, preset and place on the device. Built before
// the first trial, so that no trial waits.
#pragma once

#include "core/tick/scene.h"
#include "devices/placement.h"
#include "workbench/experiment/protocol.h"
#include "workbench/experiment/shown.h"

#include <map>
#include <memory>
#include <string>
#include <tuple>

namespace tangent::experiment {

/// A Stimulus (shown.h) as the servo takes it.
struct RenderedStimulus {
  std::shared_ptr<const ContactScene> scene;
  Preset preset;          ///< the protocol's, with the sources of force and display of the rendering condition
  std::string name;       ///< for the operator: "arc of 26 tangent segments", "cone facing left, shaded"
  std::string mesh_hash;  ///< scene_hash: 16 hex digits
  std::string made;       ///< of an object: what makes its mesh, "make cone --segments 2000 --facing left"
  /// World to scene. The person's left is the scene's -x for objects, so that the finger points along +y and strokes
  /// along the object's axis from side to side (5.3.2); an arc lies along the finger, its middle at the device's
  /// origin.
  Placement placement;
};

class Stimuli {
 public:
  /// Builds every object in every shading and facing, or the exact arc. Fails on what can't be built. The shipped
  /// identification takes some seconds: its unshaded sphere has 1.3 million triangles (Identification::facet_deg).
  static Result<Stimuli> make(const Protocol& protocol);

  /// Fails on a condition that has no name, on too few or too many segments (ArcStimulus), and where the protocol shows
  /// objects. `segments` 0: the exact arc; another one is built now, in some milliseconds.
  Result<RenderedStimulus> arc(const std::string& condition, int segments) const;
  /// One of the protocol's objects, or its practice object. `facing`: only of those that are shown both ways.
  Result<RenderedStimulus> object(const std::string& name, bool shaded, bool tactile, Facing facing) const;
  /// Either of them. Fails on Kind::none.
  Result<RenderedStimulus> rendered(const Stimulus& stimulus) const;

 private:
  struct Built {
    std::shared_ptr<const ContactScene> scene;
    std::string hash, made;
  };
  using ObjectKey = std::tuple<std::string, bool, Facing>;  ///< name, shaded, facing

  Stimuli() = default;
  Status add_object(const std::string& name, bool shaded, Facing facing);
  bool has_both_ways(const std::string& name) const;

  Protocol protocol_;
  Built exact_arc_;
  std::map<ObjectKey, Built> objects_;
};

/// Generator's segments with which the facets of an unshaded object turn by less than `facet_deg` to each other: around
/// a cone and a cylinder, subdivisions of a sphere. 0: the object is flat-faced.
int facet_segments(const std::string& object, double facet_deg);

}  // namespace tangent::experiment
