#include "core/io/pose_file.h"

#include "core/base/float_state.h"
#include "core/base/text.h"
#include "core/io/csv_table.h"
#include "core/io/input_file.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace tangent {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 30;  // about 20 million poses: 5.5 hours at 1 kHz
constexpr std::array<std::string_view, 4> kNeeded{"t_s", "x_m", "y_m", "z_m"};
constexpr std::array<std::string_view, 4> kQuaternion{"qw", "qx", "qy", "qz"};
using Numbers = std::array<double, kNeeded.size() + kQuaternion.size()>;

Result<TickInput> to_input(const CsvTable& table, const Numbers& n) {
  TickInput input;
  input.t_s = n[0];
  input.finger.position = Vec3(n[1], n[2], n[3]);
  for (std::size_t i = 1; i < 4; ++i) {
    if (std::abs(n[i]) <= kFarthestPose) continue;
    return fail(std::string(kNeeded[i]) + " is out of range", table.where(), "allowed: -1e9 to 1e9 m");
  }
  if (table.has_optional()) {
    const double length = std::hypot(std::hypot(n[4], n[5]), std::hypot(n[6], n[7]));
    if (!(std::abs(length - 1.0) <= kQuaternionLengthTolerance)) {
      std::string text = "the quaternion's length is ";
      append_double(text, length);
      return fail(text, table.where(), "allowed: 0.999 to 1.001");
    }
    input.finger.orientation = Quat(n[4] / length, n[5] / length, n[6] / length, n[7] / length);
  }
  return input;
}

/// Stamps nearer than that are of a broken clock or in another unit: at them velocities are noise. What the stamps
/// lost when they were rounded to doubles does not count.
Status check_stamp(double last_s, double t_s, const CsvTable& table) {
  const double rounded_off = 2.0 * (std::nextafter(std::abs(t_s), std::numeric_limits<double>::max()) - std::abs(t_s));
  if (t_s - last_s + rounded_off >= kLeastStampStep) return {};
  std::string what = "t_s does not increase";
  if (t_s > last_s) append_double(what = "t_s increases by only ", t_s - last_s);
  return fail(what, table.where(), "write poses in the order of time, in seconds, at least 1e-6 s apart");
}

}  // namespace

Result<std::vector<TickInput>> parse_poses(std::string_view text, std::string_view name) {
  const FloatState as_tested;
  Result<CsvTable> table = CsvTable::open(text, name, kNeeded, kQuaternion);
  if (!table) return tl::unexpected(table.error());
  std::vector<TickInput> poses;
  Numbers numbers{};
  while (table->next_line()) {
    if (Status status = table->read_numbers(numbers); !status) return tl::unexpected(status.error());
    Result<TickInput> input = to_input(*table, numbers);
    if (!input) return tl::unexpected(input.error());
    if (!poses.empty()) {
      if (Status status = check_stamp(poses.back().t_s, input->t_s, *table); !status)
        return tl::unexpected(status.error());
    }
    poses.push_back(*input);
  }
  if (poses.empty()) return fail("no poses", std::string(name), "write at least one line below the header");
  return poses;
}

Result<std::vector<TickInput>> read_poses(const std::filesystem::path& path) {
  const Result<std::string> text = read_input_file(path, kMaxBytes);
  if (!text) return tl::unexpected(text.error());
  return parse_poses(*text, path.string());
}

}  // namespace tangent
