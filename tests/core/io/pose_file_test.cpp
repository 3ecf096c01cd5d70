#include "core/io/pose_file.h"
#include "core/io/input_file.h"

#include "tests/support/approx.h"
#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <array>
#include <csignal>
#include <string>
#include <thread>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace tangent;
using namespace tangent::test;
using tangent::testing::contains;
using tangent::testing::TempFolder;

namespace {

constexpr std::string_view kHeader = "t_s,x_m,y_m,z_m\n";

std::string refusal(const std::string& text) {
  const Result<std::vector<TickInput>> poses = parse_poses(text, "p.csv");
  REQUIRE_FALSE(poses);
  return poses.error().message();
}
std::string body_refusal(const std::string& lines) { return refusal(std::string(kHeader) + lines); }

}  // namespace

TEST_CASE("positions read as the nearest doubles and without a quaternion the finger is upright") {
  const auto poses = parse_poses("t_s,x_m,y_m,z_m\n0,0.1,-2e-3,3\n0.001,1,2,3\n", "p.csv");
  REQUIRE(poses);
  REQUIRE(poses->size() == 2);
  CHECK((*poses)[0].t_s == 0.0);
  CHECK((*poses)[0].finger.position == Vec3(0.1, -2e-3, 3.0));
  CHECK((*poses)[0].finger.orientation == Quat(1.0, 0.0, 0.0, 0.0));
  CHECK((*poses)[1].t_s == 0.001);
}

TEST_CASE("line ends of either kind, a missing last one, a byte order mark and blank lines at the end") {
  for (const char* text : {"t_s,x_m,y_m,z_m\r\n0,1,2,3\r\n1,1,2,3\r\n", "t_s,x_m,y_m,z_m\n0,1,2,3\n1,1,2,3",
                           "\xEF\xBB\xBFt_s,x_m,y_m,z_m\n0,1,2,3\n1,1,2,3\n\n\r\n"}) {
    const auto poses = parse_poses(text, "p.csv");
    REQUIRE(poses);
    CHECK(poses->size() == 2);
  }
}

TEST_CASE("quaternions near unit length are normalised, others refused") {
  const std::string header = "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n";
  const auto poses = parse_poses(header + "0,0,0,0,0.7071,0.7071,0,0\n", "p.csv");
  REQUIRE(poses);
  const Quat q = (*poses)[0].finger.orientation;
  CHECK(glm::dot(q, q) == approx(1.0).epsilon(1e-15));
  CHECK(q.w == q.x);
  CHECK(contains(refusal(header + "0,0,0,0,0,0,0,0\n"),
                 "p.csv:2: the quaternion's length is 0; allowed: 0.999 to 1.001"));
  CHECK(contains(refusal(header + "0,0,0,0,1,0,0,0\n1,0,0,0,1,1,0,0\n"), "p.csv:3: the quaternion's length is 1.41"));
  CHECK(contains(refusal(header + "0,0,0,0,1e200,0,0,0\n"), "the quaternion's length is 1e+200"));
}

TEST_CASE("columns go by name: in any order, with others among them") {
  const auto poses = parse_poses("qx,z_m,qw,note,y_m,x_m,qz,t_s,qy\n0,3,1,edge,2,1,0,0.5,0\n", "p.csv");
  REQUIRE(poses);
  CHECK((*poses)[0].t_s == 0.5);
  CHECK((*poses)[0].finger.position == Vec3(1.0, 2.0, 3.0));
  CHECK((*poses)[0].finger.orientation == Quat(1.0, 0.0, 0.0, 0.0));
  const auto more = parse_poses("t_s,x_m,y_m,z_m,force_x_n\n0,1,2,3,nan\n", "p.csv");
  REQUIRE(more);
  CHECK((*more)[0].finger.position == Vec3(1.0, 2.0, 3.0));
  CHECK(contains(refusal("t_s,x_m,z_m\n0,1,2\n"), "y_m is missing"));
}

TEST_CASE("another header is refused") {
  CHECK(contains(refusal("x,y,z\n1,2,3\n"),
                 "p.csv:1: the header is \"x,y,z\": t_s is missing; write the columns t_s,x_m,y_m,z_m, and"));
  CHECK(contains(refusal("0,1,2,3\n"), "p.csv:1: the header"));
  CHECK(contains(refusal("t_s,x_m,y_m,z_m,qw\n"), "p.csv:1: the header is \"t_s,x_m,y_m,z_m,qw\": qx is missing"));
  CHECK(contains(refusal(std::string("\x7f"
                                     "ELF\x00\x01\xff",
                                     7) +
                         std::string(1000, 'x')),
                 "p.csv:1: the header is \"?ELF"));
}

TEST_CASE("numbers that are not finite are refused with line and column") {
  CHECK(body_refusal("0,0,0,0\n1,0,nan,0\n") == "p.csv:3: y_m is \"nan\"; write a finite decimal number");
  CHECK(contains(body_refusal("0,inf,0,0\n"), "p.csv:2: x_m is \"inf\""));
  CHECK(contains(body_refusal("0,1e400,0,0\n"), "p.csv:2: x_m is \"1e400\""));
  CHECK(contains(body_refusal("0,,0,0\n"), "p.csv:2: x_m is \"\""));
  CHECK(contains(body_refusal("0,1 m,0,0\n"), "p.csv:2: x_m is \"1 m\""));
  CHECK(contains(body_refusal("0,2e9,0,0\n"), "p.csv:2: x_m is out of range"));
}

TEST_CASE("wrong numbers of columns are refused with the line") {
  CHECK(contains(body_refusal("0,0,0,0\n0.1,0,0\n"), "p.csv:3: only 3 columns; write 4 fields"));
  CHECK(contains(body_refusal("0,0,0,0,1,0,0,0\n"), "p.csv:2: more columns than the header names"));
  CHECK(contains(body_refusal("0,0,0,0,\n"), "p.csv:2: more columns"));
  CHECK(contains(body_refusal("0,0,0,0\n\n1,0,0,0\n"), "p.csv:3: t_s is \"\""));
}

TEST_CASE("time must increase") {
  CHECK(contains(body_refusal("0,0,0,0\n1,0,0,0\n1,0,0,0\n"), "p.csv:4: t_s does not increase"));
  CHECK(contains(body_refusal("1,0,0,0\n0.5,0,0,0\n"), "p.csv:3: t_s does not increase"));
}

TEST_CASE("stamps nearer than a microsecond are refused with their distance, whatever the time began at") {
  CHECK(contains(body_refusal("0,0,0,0\n1e-7,0,0,0\n"),
                 "p.csv:3: t_s increases by only 1e-07; write poses in the order of time, in seconds, at least 1e-6 s "
                 "apart"));
  CHECK(contains(body_refusal("0,0,0,0\n9.9e-7,0,0,0\n"), "t_s increases by only 9.9e-07"));
  CHECK(contains(body_refusal("1000,0,0,0\n1000.0000001,0,0,0\n"), "t_s increases by only"));
  // A microsecond apart as written, though doubles that far from zero are not.
  for (const std::string start : {"0", "1", "86400", "1700000000"}) {
    CAPTURE(start);
    const std::string body = start + ".000001,0,0,0\n" + start + ".000002,0,0,0\n" + start + ".000003,0,0,0\n";
    CHECK(parse_poses(std::string(kHeader) + body, "p.csv"));
  }
}

TEST_CASE("a pose file without end is refused at what no text has, with its line") {
  CHECK(contains(read_poses("/dev/zero").error().message(),
                 "/dev/zero:1: holds a zero byte, so it is not a text; check that it is the right file"));
  CHECK_FALSE(read_poses("/dev/urandom"));
  const TempFolder folder;
  const std::string poses = std::string(kHeader) + "0,0,0,0\n";
  CHECK(contains(read_poses(folder.write("zero.csv", poses + std::string(1, '\0'))).error().message(),
                 "zero.csv:3: holds a zero byte"));
  CHECK(contains(read_poses(folder.write("line.csv", poses + std::string(70000, '1'))).error().message(),
                 "line.csv:3: a line of more than 65536 characters"));
  // The longest line that is one, over the end of a block that is read at once.
  CHECK(read_poses(folder.write("long.csv", poses + "1,1,1," + std::string(65530, '0') + "\n2,0,0,0\n")));
}

TEST_CASE("a line without end from a program that never stops writing is refused") {
  const TempFolder folder;
  const std::string pipe = folder.file("pipe.csv");
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  std::thread writer([&] {
    std::signal(SIGPIPE, SIG_IGN);
    const int fd = ::open(pipe.c_str(), O_WRONLY);
    const std::string digits(4096, '7');
    while (::write(fd, digits.data(), digits.size()) > 0) {}
    ::close(fd);
  });
  const auto poses = read_poses(pipe);
  writer.join();  // its pipe was closed at the other end
  std::signal(SIGPIPE, SIG_DFL);
  REQUIRE_FALSE(poses);
  CHECK(contains(poses.error().message(), "pipe.csv:1: a line of more than"));
}

TEST_CASE("poses from a program that never stops writing are refused with what to do") {
  const TempFolder folder;
  const std::string pipe = folder.file("pipe.csv");
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  std::size_t written = 0;
  std::thread writer([&] {
    std::signal(SIGPIPE, SIG_IGN);
    const int fd = ::open(pipe.c_str(), O_WRONLY);
    std::string text(kHeader);
    for (int tick = 0; ::write(fd, text.data(), text.size()) > 0; ++tick) {
      written += text.size();
      text = std::to_string(tick) + ",0,0,0\n";
    }
    ::close(fd);
  });
  constexpr std::size_t kLimit = std::size_t{1} << 20;
  const auto text = read_input_file(pipe, 8 * kLimit, {.max_bytes = kLimit});
  writer.join();  // its pipe was closed at the other end
  std::signal(SIGPIPE, SIG_DFL);
  REQUIRE_FALSE(text);
  CHECK(contains(text.error().message(),
                 "pipe.csv: has brought more than 1 MiB and no end; check that the program that "
                 "writes it ends, or write a file of up to 8 MiB"));
  CHECK(written < 2 * kLimit);
  // A file may hold more than a pipe brings; one that is too large is refused by its size.
  CHECK(read_input_file(folder.write("file.csv", std::string(kLimit + 1, '\n')), 8 * kLimit, {.max_bytes = kLimit}));
  CHECK(
      contains(read_input_file(folder.write("large.csv", std::string(kLimit + 1, '\n')), kLimit, {.max_bytes = kLimit})
                   .error()
                   .message(),
               "large.csv: is larger than 1 MiB"));
}

TEST_CASE("a pipe that nobody writes to is given up, and at once where the program is told to end") {
  const TempFolder folder;
  const std::string pipe = folder.file("pipe.csv");
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  constexpr std::size_t kLimit = std::size_t{1} << 20;
  CHECK(contains(read_input_file(pipe, kLimit, {.wait_for_writer_ms = 0}).error().message(),
                 "pipe.csv: is a pipe that no program has opened for writing; start the program"));
  end_waiting_for_input();  // as the first Ctrl-C does
  CHECK(contains(read_input_file(pipe, kLimit).error().message(), "pipe.csv: was interrupted"));
  const int writer = ::open(pipe.c_str(), O_RDWR);  // somebody is there, and silent
  CHECK(contains(read_input_file(pipe, kLimit).error().message(), "pipe.csv: was interrupted"));
  allow_waiting_for_input();
  ::close(writer);
  CHECK(contains(read_input_file(folder.path(), kLimit).error().message(), "is a folder; name a file"));
}

TEST_CASE("what a program that has ended left in a pipe is read to its end") {
  std::array<int, 2> ends{};
  REQUIRE(::pipe(ends.data()) == 0);
  REQUIRE(::write(ends[1], "one\n", 4) == 4);
  ::close(ends[1]);
  const std::string name = "/dev/fd/" + std::to_string(ends[0]);
  const auto text = read_input_file(name, 100);
  REQUIRE_MESSAGE(text, text.error().message());
  CHECK(*text == "one\n");
  CHECK(contains(read_input_file(name, 100).error().message(), "the file is empty"));
  ::close(ends[0]);
}

TEST_CASE("a file without poses is refused by name") {
  CHECK(contains(refusal(std::string(kHeader)), "p.csv: no poses"));
  const TempFolder folder;
  CHECK(contains(read_poses(folder.write("empty.csv", "")).error().message(), "empty.csv: the file is empty"));
  CHECK(contains(read_poses(folder.file("none.csv")).error().message(), "none.csv: can't be opened"));
}
