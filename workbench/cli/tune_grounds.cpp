#include "workbench/cli/tune_grounds.h"

#include "core/base/text.h"
#include "core/io/scene_file.h"
#include "core/lab/measure/touch_count.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/option.h"
#include "workbench/cli/text_format.h"
#include "workbench/session/two_threads.h"

#include <algorithm>

namespace tangent {
namespace {

std::string file_of(const std::string& path) { return std::filesystem::path(path).filename().string(); }

sweep::FrontGround ground_over(sweep::Ground ground, std::string name) {
  sweep::FrontGround out;
  out.ticks = std::max<std::size_t>(1, ground.motion->size() * 3 / 4);
  out.ground = std::move(ground);
  out.name = std::move(name);
  return out;
}

}  // namespace

void add_tune_ground_options(CLI::App& app, TuneGroundOptions& options) {
  add_repeated_option(app, "--poses",
                      "A motion: poses (t_s,x_m,y_m,z_m[,qw,qx,qy,qz]), a recording (.sqlite), or a made one: around, "
                      "strokes, around:0.5mm (its mean depth); again for more, with --objective (default: --path)",
                      "F.csv", [&](const std::vector<std::string>& names) { options.poses = names; });
  add_repeated_option(app, "--also-mesh", "A further mesh to be good on, with --objective; again for more", "F.obj",
                      [&](const std::vector<std::string>& names) { options.meshes = names; });
  add_repeated_option(app, "--also-radius-mm", "A further radius of the finger, with --objective; again for more", "MM",
                      [&](const std::vector<std::string>& texts) {
                        const PresetKey& key = *find_preset_key("finger.radius_m");
                        for (const std::string& text : texts) {
                          const auto mm = parse_finite_double(text);
                          if (!mm || !key.allows(*mm * 1e-3))
                            refuse_option("--also-radius-mm " + text, "is no radius; allowed: " + key.allowed());
                          options.radii_m.push_back(*mm * 1e-3);
                        }
                      });
}

TuneGrounds tune_grounds(const TuneGroundOptions& options, const MeshOptions& mesh, const Preset& preset,
                         const sweep::Ground& first, const std::string& first_motion) {
  TuneGrounds out;
  std::vector<std::string> meshes{mesh.file.string()}, motions = options.poses;
  meshes.insert(meshes.end(), options.meshes.begin(), options.meshes.end());
  if (motions.empty()) motions.push_back(first_motion);
  std::vector<double> radii{preset.finger.radius_m};
  radii.insert(radii.end(), options.radii_m.begin(), options.radii_m.end());
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const auto scene = m == 0 ? Result<std::shared_ptr<const ContactScene>>(first.scene)
                              : load_scene(meshes[m], {mesh.metres_per_unit, mesh.build, {}}, run_on_two_threads);
    if (!scene) {
      out.failed.push_back(scene.error().message());
      continue;
    }
    for (const std::string& motion : motions) {
      for (const double radius : radii) {
        std::string name = file_of(meshes[m]) + ", " + file_of(motion);
        if (radii.size() > 1) name += format(", finger %g mm", radius * 1e3);
        if (out.all.empty() && m == 0) {
          out.all.push_back(ground_over(first, name));
          continue;
        }
        Finger finger = preset.finger;
        finger.radius_m = radius;
        auto poses = sweep::motion_of(**scene, motion, finger);
        if (!poses) {
          out.failed.push_back(name + ": " + poses.error().message());
          continue;
        }
        Preset there = preset;
        there.finger = finger;
        const TouchCount touches =
            count_until_touched(*scene, there, *poses, [] { return InterruptGuard::requested(); });
        if (const std::string note = touches.note(); !note.empty() && !InterruptGuard::requested())
          out.notes.push_back(name + ": " + note);
        out.all.push_back(
            ground_over({*scene, std::make_shared<const std::vector<TickInput>>(std::move(*poses))}, name));
        if (radius != preset.finger.radius_m) out.all.back().finger = finger;
      }
    }
  }
  return out;
}

}  // namespace tangent
