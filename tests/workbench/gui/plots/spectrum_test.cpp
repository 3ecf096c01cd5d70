#include "workbench/gui/plots/spectrum.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kRate = 1000.0;

ChannelStore sine(double hz, double amplitude, double offset, std::uint64_t ticks) {
  std::vector<float> rows;
  for (std::uint64_t t = 0; t < ticks; ++t) {
    rows.push_back(static_cast<float>(
        offset + amplitude * std::sin(2.0 * std::numbers::pi * hz * static_cast<double>(t) / kRate)));
  }
  ChannelStore store(1, ticks);
  store.assign(0, rows);
  return store;
}

}  // namespace

TEST_CASE("a sine is found at its frequency with its amplitude, whatever it rides on") {
  for (const double hz : {31.25, 125.0, 250.0, 437.5}) {  // whole bins of 4096 ticks at 1 kHz
    const ChannelStore store = sine(hz, 0.03, 5.0, 20'000);
    const Spectrum s = amplitude_spectrum(store, 0, 0, 20'000, kRate);
    CHECK(s.segment_ticks == 4096);
    CHECK(s.segments > 3);
    CHECK(s.peak_hz() == approx(hz));
    CHECK(static_cast<double>(s.amplitude[s.peak]) == approx(0.03).epsilon(0.001));
    CHECK(static_cast<double>(s.amplitude[s.peak / 2]) < 1e-5);
    CHECK(s.peak_above(hz - 1.0) == s.peak);
    CHECK(s.peak_above(hz + 1.0) > s.peak);
    CHECK(s.peak_above(600.0) == 0);
  }
}

TEST_CASE("between two bins the peak is the nearest one, at most 1.5 dB low") {
  const double hz = 100.5 * kRate / 4096.0;
  const Spectrum s = amplitude_spectrum(sine(hz, 1.0, 0.0, 8192), 0, 0, 8192, kRate);
  CHECK(std::abs(s.peak_hz() - hz) <= 0.51 * s.bin_hz);
  CHECK(static_cast<double>(s.amplitude[s.peak]) > 0.84);
}

TEST_CASE("a short range has a coarser spectrum, too short a one none - a constant has no peak") {
  const ChannelStore store = sine(125.0, 1.0, 0.0, 5000);
  const Spectrum s = amplitude_spectrum(store, 0, 100, 700, kRate);
  CHECK(s.segment_ticks == 512);
  CHECK(s.peak_hz() == approx(125.0));
  CHECK(amplitude_spectrum(store, 0, 100, 160, kRate).empty());
  CHECK(amplitude_spectrum(store, 0, 9000, 9900, kRate).empty());
  const ChannelStore constant = sine(0.0, 0.0, 2.0, 5000);
  CHECK(amplitude_spectrum(constant, 0, 0, 5000, kRate).peak == 0);
}

TEST_CASE("segments with lost ticks are left out") {
  ChannelStore store(1, 1);
  for (std::uint64_t t = 0; t < 20'000; ++t) {
    if (t % 5000 == 1234) continue;
    const float v = static_cast<float>(std::sin(2.0 * std::numbers::pi * 125.0 * static_cast<double>(t) / kRate));
    store.push(t, std::vector<float>{v});
  }
  const Spectrum s = amplitude_spectrum(store, 0, 0, 20'000, kRate);
  REQUIRE(s.segments > 0);
  CHECK(s.segments < 5);
  CHECK(static_cast<double>(s.amplitude[s.peak]) == approx(1.0).epsilon(0.001));
}
