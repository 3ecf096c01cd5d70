#include "workbench/recording/compare_recordings.h"

#include "tests/support/approx.h"
#include "tests/workbench/recording/recording_fixture.h"

#include <cmath>

using namespace tangent;
using namespace tangent::test;

namespace {

/// 3 s of the simulated hand; `late`: ticks that pass before the recording begins.
void record_some(const std::filesystem::path& path, double stiffness_n_per_m = 0.0, std::uint64_t ticks = 3000) {
  RecordedSession recorded(path);
  if (stiffness_n_per_m > 0.0) {
    Preset preset = recorded.session->preset();
    preset.force.stiffness_n_per_m = stiffness_n_per_m;
    REQUIRE(recorded.session->set_preset(preset));
  }
  recorded.run(ticks);
  recorded.finish();
}

RecordingsCompared compared(const Result<RecordingsCompared>& result) {
  REQUIRE_MESSAGE(result, (result ? "" : message_of(result.error())));
  return *result;
}

const QuantityDifference& of(const RecordingsCompared& c, std::string_view name) {
  const auto found =
      std::find_if(c.quantities.begin(), c.quantities.end(), [&](const auto& q) { return q.name == name; });
  REQUIRE(found != c.quantities.end());
  return *found;
}

/// A copy whose ticks are numbered from `by` on, and come that much later.
std::string shifted_copy(const testing::TempFolder& folder, const std::string& path, int by) {
  const std::string copy = folder.file("shifted.sqlite"), n = std::to_string(by);
  std::filesystem::copy_file(path, copy);
  for (const char* table : {"tick_rows", "device_rows", "states", "events"}) {
    const std::string up = std::to_string(10'000'000);
    change(copy, "UPDATE " + std::string(table) + " SET tick = tick + " + up);
    change(copy, "UPDATE " + std::string(table) + " SET tick = tick - " + up + " + " + n);
  }
  change(copy, "UPDATE tick_rows SET t_s = t_s + 0.001 * " + n);
  change(copy, "DELETE FROM overview");
  return copy;
}

}  // namespace

TEST_CASE("a recording compared with itself is the same, by bounds and tick by tick") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  record_some(path);
  for (const AlignBy by : {AlignBy::time, AlignBy::tick, AlignBy::contact}) {
    CompareRecordingsOptions options;
    options.by = by;
    options.tolerance = {0.0, 0.0, 0.0};
    const RecordingsCompared c = compared(compare_fully(path, path, options));
    CHECK(c.outcome == CompareOutcome::same);
    CHECK(c.compared == 3000);
    CHECK(c.alignment.shift == 0);
    for (const QuantityDifference& q : c.quantities) CHECK(q.at_most == 0.0);
    CHECK(c.spectrum_a.windows == 4);
    CHECK(c.spectrum_a.force_n2_per_hz == c.spectrum_b.force_n2_per_hz);
    const RecordingsCompared coarse = compared(compare_coarsely(path, path, options));
    CHECK(coarse.spectrum_a.windows == 0);
    CHECK(coarse.outcome == CompareOutcome::undecided);  // of two equal ranges nobody knows more
    for (const QuantityDifference& q : coarse.quantities) CHECK(q.at_least == 0.0);
  }
}

TEST_CASE("one changed value is found with its tick, and judged by the tolerance") {
  const testing::TempFolder folder;
  const std::string a = folder.file("a.sqlite"), b = folder.file("b.sqlite");
  record_some(a);
  std::filesystem::copy_file(a, b);
  change(b, "UPDATE tick_rows SET force_y_n = force_y_n + 0.5, cld_m = cld_m - 4e-6 WHERE tick = 1777");
  CompareRecordingsOptions options;
  const RecordingsCompared c = compared(compare_fully(a, b, options));
  CHECK(c.outcome == CompareOutcome::different);
  CHECK(of(c, "force").at_most == approx(0.5));
  CHECK(of(c, "force").worst_tick == 1777);
  CHECK(of(c, "force").over == 1);
  CHECK(of(c, "force").rms == approx(0.5 / std::sqrt(3000.0)));
  CHECK(of(c, "display").over == 0);
  CHECK(of(c, "display").at_most == approx(4e-6));
  CHECK(c.worst()->name == "force");
  options.tolerance.force_n = 0.6;
  CHECK(compared(compare_fully(a, b, options)).outcome == CompareOutcome::same);
  options.from = 1778;
  options.tolerance.force_n = 0.0;
  CHECK(compared(compare_fully(a, b, options)).outcome == CompareOutcome::same);
}

TEST_CASE("long recordings are compared by two threads, which find what one would") {
  const testing::TempFolder folder;
  const std::string a = folder.file("a.sqlite"), b = folder.file("b.sqlite");
  record_some(a, 0.0, 1 << 14);
  std::filesystem::copy_file(a, b);
  change(b, "UPDATE tick_rows SET force_y_n = force_y_n + 0.25 WHERE tick IN (100, 16000)");
  const RecordingsCompared c = compared(compare_fully(a, b, {}));
  CHECK(c.compared == 1 << 14);
  CHECK(of(c, "force").over == 2);
  CHECK(of(c, "force").rms == approx(0.25 * std::sqrt(2.0 / (1 << 14))));
  CHECK(c.spectrum_a.windows == 2 * 15);  // each half of 8,192 ticks
  CHECK(of(c, "display").at_most == 0.0);
}

TEST_CASE("what the pyramids say holds for the ticks: bounds contain every difference, in every bin") {
  const testing::TempFolder folder;
  const std::string a = folder.file("a.sqlite"), b = folder.file("b.sqlite");
  record_some(a);
  record_some(b, 900.0);
  CompareRecordingsOptions options;
  options.bins = 4;
  options.tolerance.finger_m = 1.0;  // a stiffer surface is pressed in less
  const RecordingsCompared full = compared(compare_fully(a, b, options));
  const RecordingsCompared coarse = compared(compare_coarsely(a, b, options));
  CHECK(full.full);
  CHECK(full.outcome == CompareOutcome::different);
  CHECK(coarse.outcome == CompareOutcome::different);
  CHECK(coarse.compared == full.compared);
  for (std::size_t q = 0; q < full.quantities.size(); ++q) {
    CAPTURE(full.quantities[q].name);
    CHECK(coarse.quantities[q].at_least <= full.quantities[q].at_most);
    CHECK(coarse.quantities[q].at_most >= full.quantities[q].at_most);
  }
  CHECK(of(coarse, "force").at_least > 0.0);
  // Over all of them: a part of 256 ticks belongs to the bin of its first one.
  for (std::size_t i = 0; i < kComparedChannelCount; ++i) {
    double exact = 0.0, most = 0.0, least = std::numeric_limits<double>::infinity();
    double least_coarse = std::numeric_limits<double>::infinity();
    for (const ComparedBin& bin : full.bins)
      exact = std::max(exact, bin.at_most[i]), least = std::min(least, bin.least_a[i]);
    for (const ComparedBin& bin : coarse.bins)
      most = std::max(most, bin.at_most[i]), least_coarse = std::min(least_coarse, bin.least_a[i]);
    CHECK(most >= exact);
    CHECK(least_coarse == least);
  }
}

TEST_CASE("recordings that began at other times are aligned by contact, by bookmark and by time") {
  const testing::TempFolder folder;
  const std::string a = folder.file("a.sqlite");
  record_some(a);
  change(a, "INSERT INTO events(tick, t_s, kind, text) VALUES(1200, 1.2, 'bookmark', 'here')");
  const std::string b = shifted_copy(folder, a, 437);
  CompareRecordingsOptions options;
  options.tolerance = {0.0, 0.0, 0.0};
  for (const AlignBy by : {AlignBy::contact, AlignBy::bookmark}) {
    options.by = by;
    const RecordingsCompared c = compared(compare_fully(a, b, options));
    CHECK(c.alignment.shift == 437);
    CHECK(c.compared == 3000);
    CHECK(c.outcome == CompareOutcome::same);
  }
  options.note = "here";
  CHECK(compared(compare_fully(a, b, options)).outcome == CompareOutcome::same);
  options.by = AlignBy::tick;
  options.tolerance.finger_m = 1e-4;
  const RecordingsCompared by_tick = compared(compare_fully(a, b, options));
  CHECK(by_tick.alignment.shift == 0);
  CHECK(by_tick.compared + by_tick.apart == 3000 - 437);
  options.by = AlignBy::time;
  CHECK(compared(compare_fully(a, b, options)).alignment.shift == 0);
}

TEST_CASE("that two recordings can't be aligned is an outcome, with its reason") {
  const testing::TempFolder folder;
  const std::string a = folder.file("a.sqlite");
  record_some(a);
  const auto outcome = [&](const std::string& b, AlignBy by, const std::string& why) {
    CompareRecordingsOptions options;
    options.by = by;
    for (const auto& result : {compare_fully(a, b, options), compare_coarsely(a, b, options)}) {
      const RecordingsCompared c = compared(result);
      CHECK(c.outcome == CompareOutcome::not_aligned);
      CHECK_MESSAGE(says(c.why, why), c.why);
    }
  };
  outcome(a, AlignBy::bookmark, "neither has a bookmark");
  const std::string later = shifted_copy(folder, a, 5000);
  outcome(later, AlignBy::tick, "no tick in common");
  const std::string free = folder.file("free.sqlite"), slow = folder.file("slow.sqlite"),
                    moved = folder.file("moved.sqlite");
  for (const std::string& copy : {free, slow, moved}) std::filesystem::copy_file(a, copy);
  change(free, "UPDATE tick_rows SET status = 0");
  change(free, "UPDATE overview SET max_penetration_m = -1");
  outcome(free, AlignBy::contact, "the second has a tick that touches");
  change(slow, "UPDATE tick_rows SET t_s = 2 * t_s");
  outcome(slow, AlignBy::time, "one runs at 1000 Hz, the other at 500 Hz");
  change(moved, "UPDATE tick_rows SET finger_x_m = finger_x_m + 0.5");
  change(moved, "UPDATE overview SET min_finger_x_m = min_finger_x_m + 0.5, max_finger_x_m = max_finger_x_m + 0.5");
  outcome(moved, AlignBy::time, "these are other motions");
}

TEST_CASE("one recording under its own preset is the same, and under a stiffer one it differs in force alone") {
  const testing::TempFolder folder;
  const std::string a = folder.file("a.sqlite");
  record_some(a);
  CompareRecordingsOptions options;
  options.tolerance = {0.0, 0.0, 0.0};
  const RecordingsCompared same = compared(compare_under(a, {[](const Preset& p) { return p; }}, options));
  CHECK(same.outcome == CompareOutcome::same);
  CHECK(same.compared == 3000);
  const auto stiffer = [](const Preset& recorded) {
    Preset preset = recorded;
    preset.force.stiffness_n_per_m *= 2.0;
    return preset;
  };
  const RecordingsCompared c = compared(compare_under(a, {stiffer}, options));
  CHECK(c.outcome == CompareOutcome::different);
  CHECK(of(c, "force").over > 100);
  CHECK(of(c, "penetration").over == 0);
  CHECK(of(c, "contact").over == 0);
}

TEST_CASE("ticks that one recording lacks are counted, and damaged values are an error") {
  const testing::TempFolder folder;
  const std::string a = folder.file("a.sqlite"), b = folder.file("b.sqlite");
  record_some(a);
  std::filesystem::copy_file(a, b);
  change(b, "DELETE FROM tick_rows WHERE tick BETWEEN 500 AND 509");
  const RecordingsCompared c = compared(compare_fully(a, b));
  CHECK(c.in_one_only == 10);
  CHECK(c.compared == 2990);
  change(b, "UPDATE tick_rows SET force_x_n = 'much' WHERE tick = 700");
  const auto damaged = compare_fully(a, b);
  REQUIRE(!damaged);
  CHECK(says(message_of(damaged.error()), "force_x_n"));
  CHECK(!compare_fully(a, folder.file("none.sqlite")));
  CHECK(!compare_coarsely(folder.file("none.sqlite"), a));
}
