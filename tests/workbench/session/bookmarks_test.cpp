#include "workbench/session/bookmarks.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::test;

namespace {

ServoRecord calm(std::uint64_t tick) {
  ServoRecord r;
  r.tick.tick = tick;
  r.tick.input.t_s = static_cast<double>(tick) * 1e-3;
  r.tick.output.status = TickStatus::face;
  r.tick.output.iterations = 2;
  return r;
}

}  // namespace

TEST_CASE("each trigger marks the tick that fired it, and calm ticks none") {
  Bookmarks marks;
  for (std::uint64_t t = 0; t < 5000; ++t) {
    ServoRecord r = calm(t);
    if (t == 500) r.tick.output.status = TickStatus::unconverged;
    if (t == 1000) r.tick.output.event = TickEvent::reseed;
    if (t == 1500) r.tick.output.iterations = marks.triggers.iterations_over + 1;
    if (t == 1600) r.tick.output.iterations = marks.triggers.iterations_over;
    if (t == 2000) r.device.force_command_n = {0.0, 4.0, 5.0};
    if (t == 2500) r.device.gate_fault = GateFault::force_device;
    if (t == 3000) r.device.display_fault = DeviceFault::sensor;
    marks.watch(r);
  }
  const std::vector<std::pair<BookmarkKind, std::uint64_t>> expected{
      {BookmarkKind::unconverged, 500}, {BookmarkKind::reseeded, 1000},     {BookmarkKind::iterations, 1500},
      {BookmarkKind::force, 2000},      {BookmarkKind::device_fault, 2500}, {BookmarkKind::device_fault, 3000}};
  REQUIRE(marks.all().size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(marks.all()[i].kind == expected[i].first);
    CHECK(marks.all()[i].tick == expected[i].second);
    CHECK(marks.all()[i].t_s == approx(1e-3 * static_cast<double>(expected[i].second)));
    CHECK_FALSE(marks.all()[i].note.empty());
  }
}

TEST_CASE("a trigger that fires on and on is one bookmark - one switched off marks nothing") {
  Bookmarks marks;
  marks.triggers.on[static_cast<std::size_t>(BookmarkKind::iterations)] = false;
  for (std::uint64_t t = 0; t < 3000; ++t) {
    ServoRecord r = calm(t);
    r.tick.output.iterations = 99;
    if (t >= 1000 && t < 2000 && t % 3 == 0) r.tick.output.status = TickStatus::unconverged;
    marks.watch(r);
  }
  REQUIRE(marks.all().size() == 1);
  CHECK(marks.all()[0].tick == 1002);
  CHECK(marks.all()[0].last_tick == 1998);
  CHECK(marks.all()[0].ticks == 333);
}

TEST_CASE("a person's bookmarks keep their notes, are found both ways, and outlive the history") {
  Bookmarks marks;
  const std::uint32_t late = marks.add(900, 0.9), early = marks.add(300, 0.3);
  CHECK(marks.add(300, 0.3) == early);
  marks.set_note(early, "first touch");
  CHECK(marks.find(early)->note == "first touch");
  CHECK(marks.all().front().id == early);
  CHECK(marks.after(0)->tick == 300);
  CHECK(marks.after(300)->tick == 900);
  CHECK(marks.after(900) == nullptr);
  CHECK(marks.before(900)->tick == 300);
  CHECK(marks.before(300) == nullptr);
  marks.forget_before(100'000);
  CHECK(marks.all().size() == 2);
  marks.remove(late);
  CHECK(marks.find(late) == nullptr);
  CHECK(marks.all().size() == 1);
}

TEST_CASE("what triggers set is bounded, goes with its ticks and with its run") {
  Bookmarks marks;
  const std::uint32_t mine = marks.add(10, 0.01);
  std::uint64_t t = 0;
  for (std::size_t i = 0; i < Bookmarks::kMostAutomatic + 50; ++i) {
    t += Bookmarks::kSameWithin + 1;
    ServoRecord r = calm(t);
    r.tick.output.event = TickEvent::reseed;
    marks.watch(r);
  }
  CHECK(marks.all().size() == Bookmarks::kMostAutomatic + 1);
  CHECK(marks.find(mine) != nullptr);
  marks.forget_before(t);
  CHECK(marks.all().size() == 2);
  marks.watch(calm(1));
  CHECK(marks.all().size() == 1);
  CHECK(marks.find(mine) != nullptr);
}
