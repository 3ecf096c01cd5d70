#include "core/io/ticks_file.h"

#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <sstream>

using namespace tangent;
using tangent::testing::contains;
using tangent::testing::read_text;
using tangent::testing::TempFolder;

namespace {

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream in(line.substr(0, line.find('\n')));
  for (std::string field; std::getline(in, field, ',');) out.push_back(field);
  if (!line.empty() && line.find(",\n") != std::string::npos) out.emplace_back();
  return out;
}

/// Any finite double: all exponents, subnormals too.
double any_double(std::mt19937_64& random) {
  for (;;) {
    const std::uint64_t bits = random();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) return value;
  }
}
Vec3 any_vector(std::mt19937_64& random) { return {any_double(random), any_double(random), any_double(random)}; }

}  // namespace

TEST_CASE("the columns of ticks.csv are the ones that were promised") {
  CHECK(kTicksHeader ==
        "tick,t_s,status,triangle,u,v,contact_x_m,contact_y_m,contact_z_m,normal_x,normal_y,normal_z,penetration_m,"
        "force_x_n,force_y_n,force_z_n,cld_m,error_m,iterations,triangle_changes,event,solve_ns,"
        "decided_force_x_n,decided_force_y_n,decided_force_z_n,decided_cld_m,searching");
}

TEST_CASE("every double of a tick reads back with the same bits") {
  std::mt19937_64 random(3);
  for (int i = 0; i < 1000; ++i) {
    TickRow row;
    row.tick = static_cast<std::uint64_t>(i);
    row.t_s = any_double(random);
    TickOutput& o = row.output;
    o.status = TickStatus::edge;
    o.event = TickEvent::switched;
    o.triangle = 17;
    o.u = any_double(random);
    o.v = any_double(random);
    o.contact = any_vector(random);
    o.normal = any_vector(random);
    o.penetration_m = any_double(random);
    o.force_n = any_vector(random);
    o.cld_m = any_double(random);
    o.error_m = any_double(random);
    o.iterations = 3;
    o.triangle_changes = -0;
    row.solve_ns = 1234.0;
    std::string line;
    REQUIRE(append_tick_row(line, row));
    const std::vector<std::string> text = fields(line);
    REQUIRE(text.size() == fields(std::string(kTicksHeader)).size());
    const auto same = [&](std::size_t column, double value) {
      const double back = std::strtod(text[column].c_str(), nullptr);
      return std::memcmp(&back, &value, sizeof value) == 0;
    };
    CHECK(text[0] == std::to_string(i));
    CHECK(same(1, row.t_s));
    CHECK(text[2] == "edge");
    CHECK(text[3] == "17");
    const double values[]{o.u,         o.v,         o.contact.x, o.contact.y,     o.contact.z,
                          o.normal.x,  o.normal.y,  o.normal.z,  o.penetration_m, o.force_n.x,
                          o.force_n.y, o.force_n.z, o.cld_m,     o.error_m};
    for (std::size_t k = 0; k < std::size(values); ++k) CHECK(same(4 + k, values[k]));
    CHECK(text[18] == "3");
    CHECK(text[19] == "0");
    CHECK(text[20] == "switch");
    CHECK(text[21] == "1234");
  }
}

TEST_CASE("a tick that tracks nothing has triangle -1") {
  std::string line;
  REQUIRE(append_tick_row(line, TickRow{}));
  CHECK(fields(line)[3] == "-1");
}

TEST_CASE("a value that is not finite never reaches the file") {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    TickRow row;
    row.tick = 41;
    row.output.force_n.y = bad;
    std::string line;
    const Status status = append_tick_row(line, row);
    REQUIRE_FALSE(status);
    CHECK(contains(status.error().message(), "tick 41: force_n is not finite"));
    CHECK(line.empty());
  }
}

TEST_CASE("a trace has one line per plane, with empty fields where there is no finite value") {
  const TempFolder folder;
  Result<IterationsFile> file = IterationsFile::create(folder.file("i.csv"));
  REQUIRE(file);
  IterationTrace trace;
  IterationRecord record;
  record.triangle = 5;
  record.curvature_per_m = std::numeric_limits<double>::quiet_NaN();
  record.trace_m = std::numeric_limits<double>::infinity();
  trace.push(record);
  record.stop = StopReason::converged;
  record.curvature_per_m = record.trace_m = 0.5;
  trace.push(record);
  REQUIRE(file->append(9, trace));
  REQUIRE(file->commit());
  std::istringstream in(read_text(folder.file("i.csv")));
  std::string header, first, second, end;
  std::getline(in, header);
  std::getline(in, first);
  std::getline(in, second);
  CHECK_FALSE(std::getline(in, end));
  CHECK(header == kIterationsHeader);
  const std::vector<std::string> a = fields(first + "\n"), b = fields(second + "\n"), names = fields(header);
  REQUIRE(a.size() == names.size());
  REQUIRE(b.size() == names.size());
  CHECK(a[0] == "9");
  CHECK(a[1] == "0");
  CHECK(b[1] == "1");
  CHECK(b[3] == to_string(StopReason::converged));
  CHECK(names[22] == "curvature_per_m");
  CHECK(a[22].empty());
  CHECK(b[22] == "0.5");
  CHECK(a.back().empty());
  CHECK(b.back() == "0.5");
}
