// Curves computed from others: against their definitions, over gaps, kept while ticks arrive; ghosts in the other
// plots.
#include "workbench/gui/plots/derived_curve.h"

#include "core/preset/schema.h"
#include "tests/support/approx.h"
#include "tests/workbench/gui/headless_app.h"

#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>

using namespace tangent;
using namespace tangent::test;
using tangent::test::HeadlessApp;

namespace {

constexpr double kPeriod_s = 1e-3;

ChannelExpression on(Derivation how, std::initializer_list<std::size_t> channels, double cutoff_hz = 20.0) {
  ChannelExpression out{.how = how, .cutoff_hz = cutoff_hz};
  for (const std::size_t channel : channels) out.of.push_back({.channel = channel});
  return out;
}

void push_wave(ChannelStore& store, std::uint64_t from, std::uint64_t to, double hz) {
  for (std::uint64_t tick = from; tick < to; ++tick) {
    const double t = 1e-3 * static_cast<double>(tick), w = 2.0 * std::numbers::pi * hz;
    const bool gap = tick % 500 == 250;
    const std::array<float, 3> row{static_cast<float>(std::sin(w * t)), gap ? std::nanf("") : 2.0f, -1.0f};
    store.push(tick, row);
  }
}

int vertices_of(ImU32 ink) {
  int count = 0;
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int i = 0; i < data.CmdListsCount; ++i) {
    for (const ImDrawVert& v : data.CmdLists[i]->VtxBuffer) count += v.col == ink;
  }
  return count;
}

}  // namespace

TEST_CASE("difference and magnitude are those of each tick, a gap in one curve is a gap in them") {
  ChannelStore store(3, 4000);
  push_wave(store, 0, 2000, 3.0);
  DerivedCurve difference, magnitude;
  const ChannelStore& d = difference.update(store, on(Derivation::difference, {0, 1}), kPeriod_s);
  const ChannelStore& m = magnitude.update(store, on(Derivation::magnitude, {0, 1, 2}), kPeriod_s);
  for (std::uint64_t tick = 0; tick < 2000; ++tick) {
    const double a = static_cast<double>(store.value(0, tick)), b = static_cast<double>(store.value(1, tick));
    const double got = static_cast<double>(d.value(0, tick)), size = static_cast<double>(m.value(0, tick));
    if (std::isnan(b)) {
      CHECK(std::isnan(got));
      CHECK(std::isnan(size));
      continue;
    }
    CHECK(got == approx(a - b));
    CHECK(size == approx(std::sqrt(a * a + b * b + 1.0)));
  }
}

TEST_CASE("the derivative of a sine is its cosine, a low-pass filter weakens by the first-order law") {
  ChannelStore store(3, 8000);
  push_wave(store, 0, 8000, 20.0);
  DerivedCurve slope, filter;
  const ChannelStore& s = slope.update(store, on(Derivation::derivative, {0}), kPeriod_s);
  const double w = 2.0 * std::numbers::pi * 20.0;
  CHECK(std::isnan(s.value(0, 0)));
  for (std::uint64_t tick = 1; tick < 8000; ++tick) {
    const double middle = 1e-3 * (static_cast<double>(tick) - 0.5);
    CHECK(std::abs(static_cast<double>(s.value(0, tick)) - w * std::cos(w * middle)) < 0.002 * w);
  }
  // At its own cut-off a first-order filter leaves 1 / sqrt 2, here up to the sampling.
  const ChannelStore& f = filter.update(store, on(Derivation::low_pass, {0}), kPeriod_s);
  const float most = f.min_max(0, 4000, 8000).max;
  CHECK(most == approx(std::numbers::sqrt2 / 2.0).epsilon(0.03));
}

TEST_CASE("while ticks arrive only the new ones are computed, with the result of computing all of them") {
  for (const Derivation how : {Derivation::derivative, Derivation::low_pass}) {
    ChannelStore store(3, 4000);
    DerivedCurve kept;
    const ChannelExpression spec = on(how, {1});  // the channel with gaps
    for (std::uint64_t to = 100; to <= 3000; to += 100) {
      push_wave(store, to - 100, to, 3.0);
      kept.update(store, spec, kPeriod_s);
      CHECK(kept.computed() == 100);
    }
    DerivedCurve whole;
    const ChannelStore &a = kept.update(store, spec, kPeriod_s), &b = whole.update(store, spec, kPeriod_s);
    for (std::uint64_t tick = 0; tick < 3000; ++tick) {
      const float x = a.value(0, tick), y = b.value(0, tick);
      CHECK((x == y || (std::isnan(x) && std::isnan(y))));
    }
    CHECK(kept.computed() == 0);
    store.clear();
    push_wave(store, 0, 50, 3.0);
    kept.update(store, spec, kPeriod_s);
    CHECK(kept.computed() == 50);
  }
}

TEST_CASE("operations inside each other are those of one after the other") {
  ChannelStore store(3, 4000);
  push_wave(store, 0, 3000, 3.0);
  DerivedCurve both, inner, outer;
  const ChannelExpression filtered = on(Derivation::low_pass, {1}, 50.0);
  const ChannelStore& together = both.update(store, {.how = Derivation::derivative, .of = {filtered}}, kPeriod_s);
  const ChannelStore& second =
      outer.update(inner.update(store, filtered, kPeriod_s), on(Derivation::derivative, {0}), kPeriod_s);
  for (std::uint64_t tick = 0; tick < 3000; ++tick) {
    const float x = together.value(0, tick), y = second.value(0, tick);
    CHECK(std::isnan(x) == std::isnan(y));
    if (!std::isnan(x)) CHECK(x == approx(y).epsilon(1e-3).scale(1e-3));  // the filtered ones are kept as floats
  }
}

TEST_CASE("spectrum and histogram draw the ghost where there is one") {
  HeadlessApp ui(HeadlessApp::deterministic_options(), 1600.0f, 1000.0f);
  ui.app().advance(4000);
  ui.key(HeadlessApp::kSpace);
  ui.model().time().axis().show_all();
  for (const char* mode : {"Spectrum", "Histogram"}) {
    ui.click(std::string("plots/mode/") + mode);
    ui.move({5.0f, 500.0f});
    ui.frames(20);
    const ImU32 ink = packed(mix(palette(Theme::dark).force_x, palette(Theme::dark).text, 0.75f));
    CHECK(vertices_of(ink) == 0);
    ui.model().presets().set_value(*find_preset_key("force", "stiffness_n_per_m"), 500.0);
    ui.frames(40);
    REQUIRE(ui.model().time().ghost() != nullptr);
    CHECK(vertices_of(ink) > 50);
    ui.model().presets().undo();
    ui.frames(4);
  }
}
