#include "workbench/analysis/confusion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace tangent::analysis {

ConfusionMatrix& ConfusionMatrix::operator+=(const ConfusionMatrix& other) {
  for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
  return *this;
}

std::uint64_t ConfusionMatrix::shown(std::size_t stimulus) const {
  const auto row = counts_.begin() + static_cast<std::ptrdiff_t>(stimulus * size_);
  return std::accumulate(row, row + static_cast<std::ptrdiff_t>(size_), std::uint64_t{0});
}

std::uint64_t ConfusionMatrix::answered(std::size_t answer) const {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < size_; ++i) sum += count(i, answer);
  return sum;
}

std::uint64_t ConfusionMatrix::total() const {
  return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
}

std::uint64_t ConfusionMatrix::right() const {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < size_; ++i) sum += count(i, i);
  return sum;
}

double ConfusionMatrix::accuracy() const {
  const std::uint64_t all = total();
  return all == 0 ? 0.0 : static_cast<double>(right()) / static_cast<double>(all);
}

double ConfusionMatrix::share(std::size_t stimulus, std::size_t answer) const {
  const std::uint64_t all = shown(stimulus);
  return all == 0 ? 0.0 : static_cast<double>(count(stimulus, answer)) / static_cast<double>(all);
}

RatioInterval share_interval(std::uint64_t of, std::uint64_t count) {
  constexpr double z = 1.959963984540054;  // 97.5 % of the normal distribution
  const auto n = static_cast<double>(count);
  const double share = static_cast<double>(of) / n;
  const double middle = (share + z * z / (2.0 * n)) / (1.0 + z * z / n);
  const double half = z / (1.0 + z * z / n) * std::sqrt(share * (1.0 - share) / n + z * z / (4.0 * n * n));
  return {share, std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

double information_bits(const ConfusionMatrix& matrix) {
  const auto n = static_cast<double>(matrix.total());
  double bits = 0.0;
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (std::size_t j = 0; j < matrix.size(); ++j) {
      const auto cell = static_cast<double>(matrix.count(i, j));
      if (cell == 0.0) continue;
      const auto row = static_cast<double>(matrix.shown(i)), column = static_cast<double>(matrix.answered(j));
      bits += cell / n * std::log2(cell * n / (row * column));
    }
  }
  return bits;
}

double corrected_information_bits(const ConfusionMatrix& matrix) {
  double cells = 0.0, rows = 0.0, columns = 0.0;
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    rows += matrix.shown(i) > 0;
    columns += matrix.answered(i) > 0;
    for (std::size_t j = 0; j < matrix.size(); ++j) cells += matrix.count(i, j) > 0;
  }
  const auto n = static_cast<double>(matrix.total());
  if (n == 0.0) return 0.0;
  return information_bits(matrix) - (cells - rows - columns + 1.0) / (2.0 * n * std::numbers::ln2);
}

MeanInterval information_interval(std::span<const ConfusionMatrix> participants) {
  ConfusionMatrix all(participants.front().size());
  for (const ConfusionMatrix& one : participants) all += one;
  const std::size_t n = participants.size();
  MeanInterval out{n, corrected_information_bits(all), std::numeric_limits<double>::infinity()};
  if (n < 2) return out;
  std::vector<double> values;  // as if each participant had an estimate of its own
  const auto count = static_cast<double>(n);
  for (std::size_t left_out = 0; left_out < n; ++left_out) {
    ConfusionMatrix rest(all.size());
    for (std::size_t i = 0; i < n; ++i)
      if (i != left_out) rest += participants[i];
    values.push_back(count * out.mean - (count - 1.0) * corrected_information_bits(rest));
  }
  out.half = mean_interval(values).half;
  return out;
}

}  // namespace tangent::analysis
