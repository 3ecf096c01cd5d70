#include "core/base/text.h"
#include "core/io/mesh_io.h"
#include "core/io/pose_file.h"
#include "workbench/bench/bench_case.h"

#include <algorithm>

namespace tangent::bench {
namespace {

namespace fs = std::filesystem;

constexpr double kFit = 0.080;  // m

struct PoseFile {
  fs::path mesh, poses;
  double radius_m = 0.0;
};

/// NAME-rXXX.csv
Result<PoseFile> pose_file(const fs::path& meshes, const fs::path& poses) {
  const std::string stem = poses.stem().string();
  const std::size_t mark = stem.rfind("-r");
  const auto radius = mark == std::string::npos ? std::nullopt : parse_finite_double(stem.substr(mark + 2));
  if (!radius)
    return fail("the name doesn't end in -r and the finger's radius in mm", poses.string(),
                "name it like spot-r020.csv");
  return PoseFile{meshes / (stem.substr(0, mark) + ".obj"), poses, *radius * kMillimetre};
}

BenchCase make_case(const PoseFile& file, double crease_deg) {
  BenchCase c;
  c.name = file.poses.stem().string() + "_crease_" + std::to_string(static_cast<int>(crease_deg));
  c.what = "real mesh, pressed 0.5 mm at the nearest point";
  c.mesh = [path = file.mesh] { return read_mesh(path, kMillimetre); };
  c.options.fit_m = kFit;
  c.options.crease_rad = crease_deg * kDegree;
  c.preset.finger.radius_m = file.radius_m;
  c.poses = [path = file.poses](const ContactScene&, const Finger&, int) { return read_poses(path); };
  return c;
}

}  // namespace

Result<std::vector<BenchCase>> shared_cases(const fs::path& meshes, const fs::path& poses) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(poses, error)) {
    if (entry.path().extension() == ".csv") files.push_back(entry.path());
  }
  if (error) return fail("can't be listed: " + error.message(), poses.string());
  if (files.empty()) return fail("there is no .csv file in it", poses.string());
  std::sort(files.begin(), files.end());
  std::vector<BenchCase> cases;
  for (const double crease_deg : {180.0, 45.0}) {
    for (const fs::path& path : files) {
      const Result<PoseFile> file = pose_file(meshes, path);
      if (!file) return tl::unexpected(file.error());
      if (!fs::exists(file->mesh, error)) return fail("there is no mesh for " + path.string(), file->mesh.string());
      cases.push_back(make_case(*file, crease_deg));
    }
  }
  return cases;
}

}  // namespace tangent::bench
