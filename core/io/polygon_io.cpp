#include "core/io/polygon_io.h"

#include "core/base/text.h"
#include "core/io/atomic_file.h"
#include "core/io/csv_table.h"
#include "core/io/file_bytes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

namespace tangent {
namespace {

constexpr std::array<std::string_view, 2> kColumns{"x_m", "y_m"};
constexpr std::string_view kExactArc = "# exact arc:";  // a comment to other programs

/// Cuts the next word off `line`.
std::string_view take_word(std::string_view& line) {
  const std::size_t begin = std::min(line.find_first_not_of(" \t"), line.size());
  line.remove_prefix(begin);
  const std::string_view word = line.substr(0, line.find_first_of(" \t"));
  line.remove_prefix(word.size());
  return word;
}

std::string at_line(const std::string& name, std::size_t line) { return name + ":" + std::to_string(line); }

/// Drops a repeated closing vertex and checks the polygon.
Result<PlanarPolygon> closed_and_checked(PlanarPolygon polygon) {
  std::vector<Vec2>& v = polygon.vertices;
  if (v.size() > 1 && v.front() == v.back()) {
    polygon.closed = true;
    v.pop_back();
  }
  if (Status status = check_polygon(polygon); !status) return tl::unexpected(status.error());
  return polygon;
}

/// Vertices and the one polyline of an OBJ file.
class PolylineReader {
 public:
  PolylineReader(std::string name, double metres_per_unit)
      : name_(std::move(name)), metres_per_unit_(metres_per_unit) {}

  Status line(std::string_view text, std::size_t number) {
    if (text.starts_with(kExactArc)) return exact_arc(text.substr(kExactArc.size()), number);
    text = text.substr(0, text.find('#'));
    const std::string_view keyword = take_word(text);
    if (keyword == "v") return vertex(text, number);
    if (keyword == "l") return element(text, number);
    return {};
  }

  Result<PlanarPolygon> finish() {
    if (chain_.empty()) return fail("no polyline", name_, "write an element \"l 1 2 3\"");
    PlanarPolygon polygon;
    polygon.name = name_;
    polygon.exact = exact_;
    for (const std::size_t i : chain_) {
      const Vec3& p = vertices_[i];
      // Must be planar: dropping z could make the polygon cross itself.
      if (p.z != vertices_[chain_.front()].z)
        return fail("the polyline is not flat: z of vertex " + std::to_string(i + 1) + " differs", name_,
                    "give all vertices the same z");
      polygon.vertices.emplace_back(metres_per_unit_ * p.x, metres_per_unit_ * p.y);
    }
    return closed_and_checked(std::move(polygon));
  }

 private:
  Status exact_arc(std::string_view text, std::size_t number) {
    std::array<double, 5> values{};
    for (double& value : values) {
      const std::string_view word = take_word(text);
      const std::optional<double> read = parse_finite_double(word);
      if (!read)
        return fail("an exact arc has " + show_text(word), at_line(name_, number),
                    "write x and y of its centre, its radius, its half angle in rad, and the length of its ends");
      value = *read;
    }
    exact_ = ExactArc{{metres_per_unit_ * values[0], metres_per_unit_ * values[1]},
                      metres_per_unit_ * values[2],
                      values[3],
                      metres_per_unit_ * values[4]};
    return {};
  }

  Status vertex(std::string_view text, std::size_t number) {
    Vec3 p(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = take_word(text);
      const std::optional<double> value = parse_finite_double(word);
      if (!value)
        return fail("a coordinate is " + show_text(word), at_line(name_, number), "write three finite decimal numbers");
      p[axis] = *value;
    }
    vertices_.push_back(p);
    return {};
  }

  Status element(std::string_view text, std::size_t number) {
    bool first = true;
    for (std::string_view word = take_word(text); !word.empty(); word = take_word(text)) {
      word = word.substr(0, word.find('/'));
      const std::optional<double> value = parse_finite_double(word);
      const double count = static_cast<double>(vertices_.size());
      if (!value || *value != static_cast<double>(static_cast<std::int64_t>(*value)) || *value == 0.0 ||
          std::abs(*value) > count)
        return fail("the polyline names vertex " + show_text(word), at_line(name_, number),
                    "name one of the " + std::to_string(vertices_.size()) + " vertices listed before it");
      const auto index = static_cast<std::size_t>(*value > 0.0 ? *value - 1.0 : count + *value);
      if (first && !chain_.empty() && chain_.back() != index)
        return fail("a second polyline that does not go on where the first ends", at_line(name_, number),
                    "write each polyline to a file of its own");
      if (!first || chain_.empty()) chain_.push_back(index);
      first = false;
    }
    return {};
  }

  std::string name_;
  double metres_per_unit_;
  std::vector<Vec3> vertices_;
  std::vector<std::size_t> chain_;
  std::optional<ExactArc> exact_;
};

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string obj_text(const PlanarPolygon& polygon, double metres_per_unit) {
  std::string text = "# " + polygon.name + "\n", line = "l";
  if (polygon.exact) {
    const ExactArc& arc = *polygon.exact;
    text += kExactArc;
    for (const double value : {arc.centre.x / metres_per_unit, arc.centre.y / metres_per_unit,
                               arc.radius_m / metres_per_unit, arc.half_angle_rad, arc.run_out_m / metres_per_unit})
      append_double(text += ' ', value);
    text += '\n';
  }
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    append_double(text += "v ", polygon.vertices[i].x / metres_per_unit);
    append_double(text += ' ', polygon.vertices[i].y / metres_per_unit);
    text += " 0\n";
    line += " " + std::to_string(i + 1);
  }
  return text + line + (polygon.closed ? " 1\n" : "\n");
}

}  // namespace

Result<PlanarPolygon> parse_polygon_csv(std::string_view text, const std::string& name) {
  Result<CsvTable> table = CsvTable::open(text, name, kColumns);
  if (!table) return tl::unexpected(table.error());
  PlanarPolygon polygon;
  polygon.name = name;
  std::array<double, kColumns.size()> numbers{};
  while (table->next_line()) {
    if (Status status = table->read_numbers(numbers); !status) return tl::unexpected(status.error());
    polygon.vertices.emplace_back(numbers[0], numbers[1]);
  }
  return closed_and_checked(std::move(polygon));
}

Result<PlanarPolygon> parse_polygon_obj(std::string_view text, const std::string& name, double metres_per_unit) {
  PolylineReader reader(name, metres_per_unit);
  for (std::size_t number = 1; !text.empty(); ++number)
    if (Status status = reader.line(take_line(text), number); !status) return tl::unexpected(status.error());
  return reader.finish();
}

bool is_planar_file(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".csv") return true;
  if (extension != ".obj") return false;
  const Result<FileBytes> file = read_file_bytes(path);
  if (!file) return false;
  bool lines = false;
  for (std::string_view text = file->view(); !text.empty();) {
    std::string_view line = take_line(text);
    const std::string_view keyword = take_word(line);
    if (keyword == "f") return false;
    lines = lines || keyword == "l";
  }
  return lines;
}

Result<PlanarPolygon> read_polygon(const std::filesystem::path& path, double metres_per_unit) {
  const Result<FileBytes> file = read_file_bytes(path);
  if (!file) return tl::unexpected(file.error());
  Result<PlanarPolygon> polygon = lower_extension(path) == ".csv"
                                      ? parse_polygon_csv(file->view(), path.string())
                                      : parse_polygon_obj(file->view(), path.string(), metres_per_unit);
  if (polygon) polygon->name = path.filename().string();
  return polygon;
}

Status write_polygon(const PlanarPolygon& polygon, const std::filesystem::path& path, double metres_per_unit) {
  if (lower_extension(path) == ".obj") return write_file_atomic(path, obj_text(polygon, metres_per_unit));
  if (polygon.exact)
    return fail("a CSV holds vertices alone, and no exact arc", path.string(),
                "give the file a name that ends in .obj");
  std::string text = std::string(kColumns[0]) + "," + std::string(kColumns[1]);
  const std::size_t count = polygon.vertices.size() + (polygon.closed ? 1 : 0);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2& v = polygon.vertices[i % polygon.vertices.size()];
    text += '\n';
    append_double(text, v.x);
    text += ',';
    append_double(text, v.y);
  }
  return write_file_atomic(path, text + "\n");
}

}  // namespace tangent
