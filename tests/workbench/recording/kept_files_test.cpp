// A recording of every version that wrote another file, kept: later versions open it and compute it again. And folders
// that may only be read.
#include "tests/support/paths.h"
#include "tests/workbench/recording/recording_fixture.h"

#include <filesystem>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr unsigned kNobody = 65534;

/// What `work` returns in a process that may do no more than anybody; -1: it crashed.
template <class Work>
int as_nobody(const Work& work) {
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    if (::geteuid() == 0 && (::setgid(kNobody) != 0 || ::setuid(kNobody) != 0)) ::_exit(99);
    ::_exit(work());
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// A folder that anybody may go into and nobody may write.
struct ReadOnlyFolder {
  testing::TempFolder folder;
  explicit ReadOnlyFolder(const std::function<void(const std::string& file)>& fill) {
    fill(folder.file("a.sqlite"));
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      REQUIRE(::chmod(entry.path().c_str(), 0444) == 0);
    REQUIRE(::chmod(folder.path().c_str(), 0555) == 0);
  }
  ~ReadOnlyFolder() { ::chmod(folder.path().c_str(), 0755); }
};

}  // namespace

// A later solver may come to the same contact by another way: its last bits then differ, and nothing else.
TEST_CASE("recordings of earlier versions open, and compute again to the same within rounding") {
  std::size_t files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(testing::test_assets()) / "recordings")) {
    CAPTURE(entry.path().string());
    ++files;
    auto recording = Recording::open(entry.path());
    REQUIRE_MESSAGE(recording, (recording ? "" : message_of(recording.error())));
    CHECK(recording->info().ticks == 300);
    CHECK(recording->info().closed);
    const auto events = recording->events();
    REQUIRE(events);
    CHECK_FALSE(events->empty());
    if (!recording->info().states_usable) continue;  // of another layout: for looking alone
    const auto report = replay(entry.path());
    REQUIRE_MESSAGE(report, (report ? "" : message_of(report.error())));
    CHECK(report->checked == 300);
    for (const auto& [field, difference] : report->largest) CHECK_MESSAGE(difference < 1e-15, field);
    for (const auto& [field, ticks] : report->changed) CHECK_MESSAGE(report->largest.contains(field), field);
  }
  CHECK(files >= 1);
}

TEST_CASE("a recording in a folder that may not be written is read there, and none can be made") {
#ifdef __SANITIZE_THREAD__
  MESSAGE("skipped: the thread sanitizer has no threads after fork");
  return;
#endif
  const ReadOnlyFolder read_only([](const std::string& file) {
    RecordedSession recorded(file);
    recorded.run(300);
    recorded.finish();
  });
  const std::string file = read_only.folder.file("a.sqlite"), other = read_only.folder.file("b.sqlite");
  CHECK(as_nobody([&file] {
          const auto report = replay(file);
          return report && report->checked == 300 && report->same() ? 0 : 1;
        }) == 0);
  CHECK(as_nobody([&other] {
          const auto made = RecordingFile::create(other);
          return !made && says(message_of(made.error()), "choose a folder") ? 0 : 1;
        }) == 0);
  CHECK_FALSE(std::filesystem::exists(other));
}

TEST_CASE("a recording that was cut short, in a folder that may not be written, is read or says what to do") {
  const ReadOnlyFolder read_only([](const std::string& file) {
    RecordedSession recorded(file);
    recorded.run(300);
    // As after a kill: the -wal file stays.
    for (const char* part : {"", "-wal"}) std::filesystem::copy_file(file + part, file + ".copy" + part);
    recorded.finish();
    for (const char* part : {"", "-wal"}) std::filesystem::rename(file + ".copy" + part, file + part);
  });
  const std::string file = read_only.folder.file("a.sqlite");
  CHECK(as_nobody([&file] {
          const auto recording = Recording::open(file);
          if (recording) return recording->info().ticks == 300 && !recording->info().closed ? 0 : 1;
          return says(message_of(recording.error()), "-wal") ? 0 : 2;
        }) == 0);
}
