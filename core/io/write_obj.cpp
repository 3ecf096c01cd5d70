#include "core/base/text.h"
#include "core/io/atomic_file.h"
#include "core/io/mesh_io.h"

#include <charconv>
#include <cmath>

namespace tangent {
namespace {

void append_index(std::string& line, std::uint32_t index) {
  char digits[12];
  const std::to_chars_result written = std::to_chars(digits, digits + sizeof digits, std::uint64_t{index} + 1);
  line.append(digits, written.ptr);
}

/// A number whose product with `unit` is exactly `value`, where there is one. It is the quotient or a neighbouring
/// double.
double in_unit(double value, double unit) {
  const double quotient = value / unit;
  if (!std::isfinite(quotient) || quotient * unit == value) return quotient;
  const double below = std::nextafter(quotient, -INFINITY), above = std::nextafter(quotient, INFINITY);
  if (below * unit == value) return below;
  if (above * unit == value) return above;
  return quotient;
}

void append_vector(std::string& line, const char* keyword, const Vec3& v) {
  line.assign(keyword);
  for (int i = 0; i < 3; ++i) {
    line += ' ';
    append_double(line, v[i]);
  }
  line += '\n';
}

}  // namespace

Status write_obj(const PolygonMesh& mesh, const std::filesystem::path& path, double metres_per_unit,
                 std::string_view comment) {
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return tl::unexpected<Error>(file.error());
  std::string line;  // write errors are reported by commit
  if (!comment.empty()) file->write("# " + std::string(comment) + "\n");
  for (const Vec3& p : mesh.positions) {
    append_vector(line, "v",
                  {in_unit(p.x, metres_per_unit), in_unit(p.y, metres_per_unit), in_unit(p.z, metres_per_unit)});
    file->write(line);
  }
  for (const Vec3& n : mesh.normals) {
    append_vector(line, "vn", n);
    file->write(line);
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    line.assign(1, 'f');
    for (std::uint32_t corner = mesh.face_offsets[f]; corner < mesh.face_offsets[f + 1]; ++corner) {
      line += ' ';
      append_index(line, mesh.corner_position[corner]);
      const std::uint32_t normal = mesh.corner_normal.empty() ? kNone : mesh.corner_normal[corner];
      if (normal == kNone) continue;
      line += "//";
      append_index(line, normal);
    }
    line += '\n';
    file->write(line);
  }
  return file->commit(true);
}

}  // namespace tangent
