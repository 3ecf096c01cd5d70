#include "core/io/pose_file.h"

#include "core/base/text.h"
#include "core/io/input_file.h"

#include <array>
#include <cmath>
#include <string>

namespace tangent {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 32;  // about 80 million poses
constexpr std::string_view kShortHeader = "t_s,x_m,y_m,z_m";
constexpr std::string_view kLongHeader = "t_s,x_m,y_m,z_m,qw,qx,qy,qz";
constexpr std::array<std::string_view, 8> kColumns{"t_s", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"};

/// Cuts the next line off `text`, without its line end ("\n" or "\r\n").
std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

/// Text of a damaged file, short and printable.
std::string shown(std::string_view text) {
  std::string out = "\"";
  for (const char c : text.substr(0, 40)) out += c >= ' ' && c < 127 ? c : '?';
  return out + (text.size() > 40 ? "...\"" : "\"");
}

struct Line {
  std::string_view text;
  std::string_view name;
  std::size_t number = 0;
  std::string where() const { return std::string(name) + ":" + std::to_string(number); }
};

Status read_numbers(const Line& line, std::size_t columns, std::array<double, 8>& numbers) {
  const char* next = line.text.data();
  const char* const last = next + line.text.size();
  for (std::size_t i = 0; i < columns; ++i) {
    const char* end = next;
    while (end != last && *end != ',') ++end;
    const std::string_view field(next, static_cast<std::size_t>(end - next));
    const std::optional<double> value = parse_finite_double(field);
    if (!value) {
      return fail(std::string(kColumns[i]) + " is " + shown(field), line.where(), "write a finite decimal number");
    }
    numbers[i] = *value;
    const bool wanted_more = i + 1 < columns;
    if ((end != last) != wanted_more) {
      return fail(wanted_more ? "only " + std::to_string(i + 1) + " columns" : "more columns than the header names",
                  line.where(), "write " + std::to_string(columns) + " numbers separated by commas");
    }
    next = end == last ? end : end + 1;
  }
  return {};
}

Result<TickInput> to_input(const Line& line, std::size_t columns, const std::array<double, 8>& n) {
  TickInput input;
  input.t_s = n[0];
  input.finger.position = Vec3(n[1], n[2], n[3]);
  for (std::size_t i = 1; i < 4; ++i) {
    if (std::abs(n[i]) <= kFarthestPose) continue;
    return fail(std::string(kColumns[i]) + " is out of range", line.where(), "allowed: -1e9 to 1e9 m");
  }
  if (columns == kColumns.size()) {
    const double length = std::hypot(std::hypot(n[4], n[5]), std::hypot(n[6], n[7]));
    if (!(std::abs(length - 1.0) <= kQuaternionLengthTolerance)) {
      std::string text = "the quaternion's length is ";
      append_double(text, length);
      return fail(text, line.where(), "allowed: 0.999 to 1.001");
    }
    input.finger.orientation = Quat(n[4] / length, n[5] / length, n[6] / length, n[7] / length);
  }
  return input;
}

}  // namespace

Result<std::vector<TickInput>> parse_poses(std::string_view text, std::string_view name) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  Line line{take_line(text), name, 1};
  if (line.text != kShortHeader && line.text != kLongHeader) {
    return fail("the header is " + shown(line.text), line.where(),
                "write " + std::string(kShortHeader) + " or " + std::string(kLongHeader));
  }
  const std::size_t columns = line.text == kLongHeader ? 8 : 4;
  std::vector<TickInput> poses;
  std::array<double, 8> numbers{};
  while (!text.empty()) {
    line.text = take_line(text);
    ++line.number;
    if (line.text.empty() && text.find_first_not_of("\r\n") == std::string_view::npos) break;  // blank end
    if (Status status = read_numbers(line, columns, numbers); !status) return tl::unexpected(status.error());
    Result<TickInput> input = to_input(line, columns, numbers);
    if (!input) return tl::unexpected(input.error());
    if (!poses.empty() && !(input->t_s > poses.back().t_s)) {
      return fail("t_s does not increase", line.where(), "write poses in the order of time, each time once");
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
