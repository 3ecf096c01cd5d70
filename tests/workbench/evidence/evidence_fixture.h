// A folder with a mesh, a pose file and a preset that names both as its evidence, all by a seed.
#pragma once

#include "core/io/mesh_io.h"
#include "core/lab/objects/generate.h"
#include "tests/support/temp_folder.h"
#include "workbench/evidence/attach_evidence.h"
#include "workbench/evidence/check_preset.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <string>

namespace tangent::testing {

struct EvidenceFolder {
  TempFolder folder;
  std::mt19937_64 random;
  std::string preset = folder.file("p.toml");

  /// Measures and writes the preset.
  explicit EvidenceFolder(unsigned seed, Method method = Method::paper) : random(seed) {
    write_ball(folder.file("ball.obj"));
    write_poses("poses.csv", 150);
    PresetFile file;
    file.preset.solver.method = method;
    file.preset.solver.gain_overall = 0.8 + 0.4 * between();
    file.preset.solver.gain_curvature_m = 0.01 + 0.02 * between();
    file.preset.finger.radius_m = 0.01 + 0.01 * between();
    PresetEvidence asked;
    asked.mesh.source = "ball.obj";
    asked.motion.kind = MotionKind::poses;
    asked.motion.file = "poses.csv";
    attach(std::move(file), std::move(asked));
  }

  double between() { return std::uniform_real_distribution<double>(0.0, 1.0)(random); }

  void attach(PresetFile file, PresetEvidence asked) const {
    const auto attached = attach_evidence(std::move(file), std::move(asked), {.folder = folder.path(), .timed = true});
    REQUIRE_MESSAGE(attached.has_value(), (attached ? "" : attached.error().message()));
    REQUIRE(attached->has_value());
    REQUIRE(write_preset(**attached, preset));
  }

  PresetFile read() const {
    const Result<PresetFile> file = read_preset(preset);
    REQUIRE_MESSAGE(file.has_value(), (file ? "" : file.error().message()));
    return *file;
  }
  void write(const PresetFile& file) const { REQUIRE(write_preset(file, preset)); }

  PresetCheck check() const { return check_of(preset); }
  static PresetCheck check_of(const std::filesystem::path& path) {
    const auto check = check_preset_file(path, {});
    REQUIRE(check.has_value());
    return *check;
  }

  /// A sphere of 30 mm, its vertices up to 0.3 mm off.
  void write_ball(const std::string& path) {
    PolygonMesh ball = make_icosphere(0.03, 2);
    for (Vec3& p : ball.positions) p *= 1.0 + 0.01 * between();
    ball.normals.clear();
    ball.corner_normal.clear();
    REQUIRE(write_obj(ball, path, 1e-3));
  }

  /// Over the top of the ball, about 1 mm deep for a finger of 15 mm.
  void write_poses(const std::string& name, int count) {
    std::string text = "t_s,x_m,y_m,z_m\n";
    const double turn = 6.283 * between(), height = 0.043 + 0.002 * between();
    for (int i = 0; i < count; ++i) {
      const double a = -0.3 + 0.6 * i / count;
      text += std::to_string(1e-3 * i) + "," + std::to_string(height * std::sin(a) * std::cos(turn)) + "," +
              std::to_string(height * std::sin(a) * std::sin(turn)) + "," + std::to_string(height * std::cos(a)) + "\n";
    }
    folder.write(name, text);
  }
};

}  // namespace tangent::testing
