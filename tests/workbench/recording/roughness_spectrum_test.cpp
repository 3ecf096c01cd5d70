#include "workbench/recording/roughness_spectrum.h"

#include "tests/support/approx.h"
#include "workbench/recording/spectrum_figure.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <sstream>

using namespace tangent;
using namespace tangent::test;

namespace {

double sum_of(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

}  // namespace

TEST_CASE("the density of a window sums to the windowed signal's power: Parseval") {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  SpectrumCounter counter(1000.0);
  constexpr std::size_t n = 1024;
  std::vector<Vec3> force;
  std::vector<double> display_mm;
  for (std::size_t i = 0; i < n; ++i) {
    force.emplace_back(normal(random), 3.0 + 0.1 * normal(random), 0.01 * static_cast<double>(i));
    display_mm.push_back(0.5 + normal(random));
    counter.add(force.back(), 1e-3 * display_mm.back(), i > 0);
  }
  const RoughnessSpectrum all = counter.done(0.0);
  REQUIRE(all.windows == 1);
  REQUIRE(all.window_ticks == n);
  CHECK(all.hz.size() == n / 2 + 1);
  CHECK(all.hz.back() == 500.0);
  Vec3 mean_force(0.0);
  double mean_display = 0.0, squares = 0.0, force_power = 0.0, display_power = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    mean_force += force[i] / static_cast<double>(n);
    mean_display += display_mm[i] / static_cast<double>(n);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double w = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n));
    squares += w * w;
    force_power += w * w * glm::dot(force[i] - mean_force, force[i] - mean_force);
    display_power += w * w * (display_mm[i] - mean_display) * (display_mm[i] - mean_display);
  }
  const double bin_hz = 1000.0 / static_cast<double>(n);
  CHECK(bin_hz * sum_of(all.force_n2_per_hz) == approx(force_power / squares).epsilon(1e-12));
  CHECK(bin_hz * sum_of(all.display_mm2_per_hz) == approx(display_power / squares).epsilon(1e-12));
}

TEST_CASE("a pure sine is a peak at its frequency, and its power is half its amplitude squared") {
  for (const double rate : {1000.0, 250.0, 4000.0}) {
    SpectrumCounter counter(rate);
    const double bin_hz = rate / static_cast<double>(counter.done().window_ticks),
                 hz = std::round(90.0 / bin_hz) * bin_hz;
    CAPTURE(rate);
    for (int i = 0; i < 10 * static_cast<int>(rate); ++i) {
      const double turn = 2.0 * std::numbers::pi * hz * i / rate;
      counter.add({5.0, 0.2 * std::sin(turn), 0.3 * std::cos(turn)}, 4e-6 * std::sin(turn), i > 0);
    }
    const RoughnessSpectrum found = counter.done();
    REQUIRE(found.windows > 10);
    CHECK(found.hz.front() >= kRoughFrom_hz);
    CHECK(found.hz.front() < kRoughFrom_hz + bin_hz);
    const auto peak_hz = [&](const std::vector<double>& density) {
      return found.hz[static_cast<std::size_t>(std::max_element(density.begin(), density.end()) - density.begin())];
    };
    CHECK(peak_hz(found.force_n2_per_hz) == approx(hz));
    CHECK(peak_hz(found.display_mm2_per_hz) == approx(hz));
    const double expected = 0.5 * (0.2 * 0.2 + 0.3 * 0.3);
    CHECK(bin_hz * sum_of(found.force_n2_per_hz) == approx(expected).epsilon(1e-9));
    CHECK(bin_hz * sum_of(found.display_mm2_per_hz) == approx(0.5 * 4e-3 * 4e-3).epsilon(1e-9));
  }
}

TEST_CASE("white noise is as dense everywhere as its variance over its band") {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  SpectrumCounter counter(1000.0);
  for (int i = 0; i < 200'000; ++i) counter.add({normal(random), 0.0, 0.0}, 1e-3 * normal(random), i > 0);
  const RoughnessSpectrum found = counter.done();
  CHECK(found.windows == 389);
  for (const auto* density : {&found.force_n2_per_hz, &found.display_mm2_per_hz}) {
    CHECK(sum_of(*density) / static_cast<double>(density->size()) == approx(1.0 / 500.0).epsilon(0.02));
    const auto [least, most] = std::minmax_element(density->begin(), density->end() - 1);
    CHECK(*least > 0.6 / 500.0);
    CHECK(*most < 1.5 / 500.0);
  }
}

TEST_CASE("windows hold no gap, and parts of a run join") {
  SpectrumCounter gaps(1000.0), whole(1000.0), part(1000.0);
  for (int i = 0; i < 5000; ++i) gaps.add({1.0 * (i % 7), 0.0, 0.0}, 0.0, i % 1000 != 0);
  CHECK(gaps.done().windows == 0);
  CHECK(gaps.done().hz.empty());
  for (int i = 0; i < 2048; ++i) {
    whole.add({1.0 * (i % 7), 0.0, 0.0}, 0.0, i % 1024 != 0);
    if (i < 1024) part.add({1.0 * (i % 7), 0.0, 0.0}, 0.0, i > 0);
  }
  SpectrumCounter later(1000.0);
  for (int i = 1024; i < 2048; ++i) later.add({1.0 * (i % 7), 0.0, 0.0}, 0.0, i > 1024);
  part.join(later);
  CHECK(part.done().windows == 2);
  CHECK(part.done().force_n2_per_hz == whole.done().force_n2_per_hz);
}

TEST_CASE("ticks that are too slow for any frequency of roughness have no spectrum") {
  SpectrumCounter slow(30.0), enough(50.0);
  for (int i = 0; i < 1000; ++i) {
    slow.add({std::sin(0.7 * i), 0.0, 0.0}, 0.0, i > 0);
    enough.add({std::sin(0.7 * i), 0.0, 0.0}, 0.0, i > 0);
  }
  CHECK(slow.done().windows == 0);
  CHECK(slow.done().hz.empty());
  CHECK(enough.done().hz.back() == 25.0);
}

TEST_CASE("the figure of two spectra names frequency and both densities, with their units") {
  SpectrumCounter counter(1000.0);
  for (int i = 0; i < 1024; ++i) counter.add({std::sin(0.7 * i), 0.0, 0.0}, 0.0, i > 0);
  const RoughnessSpectrum one = counter.done();
  const Figure figure = spectrum_figure("s", {{"first", &one}, {"second", &one}});
  const std::string csv = figure.data.front().table.csv();
  CHECK(csv.starts_with("hz,force_n2_per_hz_1,force_n2_per_hz_2,display_mm2_per_hz_1,display_mm2_per_hz_2\n"));
  CHECK(figure.data.front().table.rows.size() == one.hz.size());
  CHECK(figure.title.find("Hann windows of 1024 ticks, half over each other, 1 of them") != std::string::npos);
}
