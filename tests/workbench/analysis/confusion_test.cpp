#include "workbench/analysis/confusion.h"

#include "workbench/experiment/paper_results.h"

#include "core/base/split_mix.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>

namespace tangent::analysis {

using test::approx;
namespace {

ConfusionMatrix paper_matrix() {
  ConfusionMatrix out(7);
  for (std::size_t i = 0; i < 7; ++i)
    for (std::size_t j = 0; j < 7; ++j)
      out.add(i, j, static_cast<std::uint64_t>(std::lround(1000.0 * experiment::kPaperConfusionPercent[i][j])));
  return out;
}

TEST_CASE("the paper's table: its mean diagonal, its extremes and the information in it") {
  const ConfusionMatrix table = paper_matrix();
  double diagonal = 0.0;
  for (std::size_t i = 0; i < 7; ++i) diagonal += experiment::kPaperConfusionPercent[i][i] / 7.0;
  CHECK(diagonal == approx(experiment::kPaperAccuracyPercent).epsilon(0.001));
  CHECK(table.share(4, 0) == approx(0.201).epsilon(0.01));  // the tetrahedron taken for a cone
  CHECK(information_bits(table) == approx(1.82).epsilon(0.003));
  for (std::size_t i = 0; i < 7; ++i) {
    double row = 0.0;
    for (const double percent : experiment::kPaperConfusionPercent[i]) row += percent;
    CHECK(std::abs(row - 100.0) < 0.4);  // as printed
  }
}

TEST_CASE("answers that are always right tell all, answers by chance nothing") {
  ConfusionMatrix right(7), chance(7);
  for (std::size_t i = 0; i < 7; ++i) {
    right.add(i, i, 10);
    for (std::size_t j = 0; j < 7; ++j) chance.add(i, j, 10);
  }
  CHECK(information_bits(right) == approx(std::log2(7.0)));
  CHECK(std::abs(information_bits(chance)) < 1e-12);
  CHECK(right.accuracy() == 1.0);
  CHECK(chance.accuracy() == approx(1.0 / 7.0));
  CHECK(ConfusionMatrix(7).accuracy() == 0.0);
}

TEST_CASE("a share's interval holds the truth in 95 of 100, and never leaves 0 to 1") {
  SplitMix random(3);
  int held = 0;
  constexpr int kTrials = 4000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double truth = 0.05 + 0.9 * random.unit();
    std::uint64_t hits = 0;
    for (int i = 0; i < 50; ++i) hits += random.unit() < truth;
    const RatioInterval interval = share_interval(hits, 50);
    held += interval.low <= truth && truth <= interval.high;
  }
  MESSAGE("held: ", held, " of ", kTrials);
  CHECK(held > 0.94 * kTrials);
  CHECK(held < 0.965 * kTrials);
  CHECK(share_interval(0, 10).low == 0.0);
  CHECK(share_interval(10, 10).high == approx(1.0));
  CHECK(share_interval(0, 10).high > 0.2);
}

/// A group that answers as the table says, `trials` of each object a participant.
std::vector<ConfusionMatrix> made_group(int participants, int trials, SplitMix& random) {
  const ConfusionMatrix table = paper_matrix();
  std::vector<ConfusionMatrix> out(static_cast<std::size_t>(participants), ConfusionMatrix(7));
  for (ConfusionMatrix& one : out) {
    for (std::size_t i = 0; i < 7; ++i) {
      for (int t = 0; t < trials; ++t) {
        double at = random.unit();
        std::size_t answer = 0;
        while (answer < 6 && (at -= table.share(i, answer)) >= 0.0) ++answer;
        one.add(i, answer);
      }
    }
  }
  return out;
}

TEST_CASE("information of a group of the paper's size: corrected on the mark, the interval holds it") {
  const double truth = information_bits(paper_matrix());
  SplitMix random(8);
  double plain = 0.0, corrected = 0.0;
  int held = 0;
  constexpr int kGroups = 400;
  for (int g = 0; g < kGroups; ++g) {
    const auto group = made_group(experiment::kPaperIdentificationParticipants, 16, random);
    ConfusionMatrix all(7);
    for (const auto& one : group) all += one;
    plain += information_bits(all) / kGroups;
    const MeanInterval interval = information_interval(group);
    corrected += interval.mean / kGroups;
    held += interval.low() <= truth && truth <= interval.high();
  }
  MESSAGE("truth ", truth, ", plain ", plain, ", corrected ", corrected, " bits; held ", held, " of ", kGroups);
  CHECK(plain > truth + 0.005);
  CHECK(std::abs(corrected - truth) < 0.004);
  CHECK(held >= 0.93 * kGroups);
  CHECK(held <= 0.985 * kGroups);
}

TEST_CASE("one participant has an estimate and no interval") {
  SplitMix random(1);
  const MeanInterval one = information_interval(made_group(1, 16, random));
  CHECK(one.mean > 1.0);
  CHECK(std::isinf(one.half));
}

}  // namespace
}  // namespace tangent::analysis
