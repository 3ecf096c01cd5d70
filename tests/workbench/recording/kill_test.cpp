// Processes that record are killed at random moments: what they wrote until then can be read and computed again.
#include "tests/workbench/recording/recording_fixture.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <random>
#include <thread>

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>

using namespace tangent;
using namespace tangent::test;

namespace {

/// In a process of its own: records until it is killed, and says how many ticks the servo has done.
[[noreturn]] void record_until_killed(const std::string& path, std::atomic<std::uint64_t>& done) {
  SessionOptions options;
  options.servo.realtime = false;
  options.history_s = 1.0;
  auto session = Session::create(built(torus_source()), Preset{}, options);
  auto recorder = SessionRecorder::start(**session, path, {torus_source(), "torus", true});
  if (!recorder || !(*session)->start()) ::_exit(1);
  for (;;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    (*session)->poll();
    (*recorder)->poll();
    done.store((*session)->status().servo.ticks);
  }
}

int kills() {
  const char* asked = std::getenv("TANGENT_KILLS");
  return asked != nullptr ? std::max(1, std::atoi(asked)) : 20;
}

}  // namespace

TEST_CASE("a recording that is killed at any moment keeps all but its newest ticks - TANGENT_KILLS=1000 kills more") {
#ifdef __SANITIZE_THREAD__
  MESSAGE("skipped: the thread sanitizer has no threads after fork");
  return;
#endif
  void* shared =
      ::mmap(nullptr, sizeof(std::atomic<std::uint64_t>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  REQUIRE(shared != MAP_FAILED);
  auto& done = *new (shared) std::atomic<std::uint64_t>(0);
  static_cast<void>(torus_source());  // before the fork: the mesh is shared
  const testing::TempFolder folder;
  std::mt19937 random(7);
  std::vector<std::uint64_t> lost;
  for (int i = 0; i < kills(); ++i) {
    CAPTURE(i);
    const std::string path = folder.file("k.sqlite");
    for (const char* end : {"", "-wal", "-shm"}) std::filesystem::remove(path + end);
    done.store(0);
    const pid_t child = ::fork();
    if (child == 0) record_until_killed(path, done);
    REQUIRE(child > 0);
    const std::uint64_t when = 5 + random() % 400;
    int status = 0;
    pid_t ended = 0;
    while (done.load() < when && ended == 0) {
      std::this_thread::sleep_for(std::chrono::microseconds(random() % 500));
      ended = ::waitpid(child, &status, WNOHANG);
    }
    REQUIRE(ended == 0);  // else it could not record
    ::kill(child, SIGKILL);
    const std::uint64_t ticks = done.load();
    ::waitpid(child, &status, 0);
    REQUIRE(WIFSIGNALED(status));
    auto recording = Recording::open(path);
    REQUIRE_MESSAGE(recording, (recording ? "" : message_of(recording.error())));
    CHECK_FALSE(recording->info().closed);
    CHECK(recording->info().missing == 0);
    const std::uint64_t kept = recording->info().ticks;
    lost.push_back(ticks > kept ? ticks - kept : 0);
    if (kept == 0) continue;
    CHECK(recording->info().first_tick == 0);
    const auto report = replay(path);
    REQUIRE_MESSAGE(report, (report ? "" : message_of(report.error())));
    CHECK(report->same());
    CHECK(report->checked == kept);
  }
  std::sort(lost.begin(), lost.end());
  const std::uint64_t median = lost[lost.size() / 2], most = lost.back();
  MESSAGE("ms lost by " << lost.size() << " kills: median " << median << ", most " << most);
  // Ticks are milliseconds. The most depends on what else the machine does; it is measured, and stands in the page.
  CHECK(median <= 250);
  ::munmap(shared, sizeof(std::atomic<std::uint64_t>));
}
