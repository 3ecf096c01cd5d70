// What the cells of a plan read: meshes and motions. Loaded when a cell first asks, kept while the next cells ask for
// the same.
#pragma once

#include "workbench/sweep/plan.h"

#include "core/tick/step.h"

#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace tangent::sweep {

/// A mesh and a motion over it, ready for ticks.
struct Ground {
  std::shared_ptr<const ContactScene> scene;
  std::shared_ptr<const std::vector<TickInput>> motion;
};

/// The motion of a recording: its ticks' inputs, those with a gap before them too.
Result<std::vector<TickInput>> recorded_motion(const std::filesystem::path& recording);

/// The motion of that name over the scene: made for the finger, of a recording, or of a pose file.
Result<std::vector<TickInput>> motion_of(const ContactScene& scene, const std::string& poses, const Finger& finger);

/// What looks at each motion as it is loaded.
struct InputWatch {
  std::function<void(const std::string&)> note = {};  ///< once of each that touches nothing; empty: nobody looks
  std::function<bool()> stop = {};                    ///< asked while it looks
};

/// Safe from several threads: one that asks for what another is loading waits for it.
class Inputs {
 public:
  explicit Inputs(const Plan& plan, InputWatch watch = {});
  /// Fails with the reason why the mesh or the motion can't be had; asked again, with the same.
  Result<Ground> ground(std::size_t mesh, std::size_t poses, std::size_t finger);

 private:
  using Scene = Result<std::shared_ptr<const ContactScene>>;
  using Motion = Result<std::shared_ptr<const std::vector<TickInput>>>;
  Scene scene(std::size_t mesh);
  void look_at(const std::shared_ptr<const ContactScene>& scene, const std::array<std::size_t, 3>& which);
  Motion load_motion(const ContactScene& scene, std::size_t poses, std::size_t finger) const;

  const Plan plan_;
  const InputWatch watch_;
  std::set<std::array<std::size_t, 3>> looked_at_;
  std::mutex guard_;
  std::size_t scene_of_ = 0;
  std::array<std::size_t, 3> motion_of_{};  ///< mesh, poses, finger
  std::unique_ptr<const Scene> scene_;
  std::unique_ptr<const Motion> motion_;
};

}  // namespace tangent::sweep
