// Who was taken for whom: a matrix of stimuli (rows) and answers (columns), its accuracy, and how much of what was
// shown the answers tell.
#pragma once

#include "core/lab/measure/interval.h"

#include <cstdint>
#include <span>
#include <vector>

namespace tangent::analysis {

class ConfusionMatrix {
 public:
  explicit ConfusionMatrix(std::size_t size) : size_(size), counts_(size * size, 0) {}
  void add(std::size_t stimulus, std::size_t answer, std::uint64_t times = 1) {
    counts_[stimulus * size_ + answer] += times;
  }
  ConfusionMatrix& operator+=(const ConfusionMatrix& other);

  std::size_t size() const { return size_; }
  std::uint64_t count(std::size_t stimulus, std::size_t answer) const { return counts_[stimulus * size_ + answer]; }
  std::uint64_t shown(std::size_t stimulus) const;
  std::uint64_t answered(std::size_t answer) const;
  std::uint64_t total() const;
  std::uint64_t right() const;
  double accuracy() const;                                       ///< 0 where there is nothing
  double share(std::size_t stimulus, std::size_t answer) const;  ///< of what was shown, 0 to 1

 private:
  std::size_t size_;
  std::vector<std::uint64_t> counts_;
};

/// A share of `count` with its 95 % interval (Wilson 1927). Precondition: count > 0.
RatioInterval share_interval(std::uint64_t of, std::uint64_t count);

/// Information that the answers carry of the stimulus, bits, as the counts have it. Too high with few counts.
double information_bits(const ConfusionMatrix& matrix);

/// Less what chance adds on average (Miller 1955): (cells - rows - columns + 1) / (2 N ln 2) for those that occurred.
double corrected_information_bits(const ConfusionMatrix& matrix);

/// The corrected one over all participants together, and its 95 % interval from leaving out one participant after the
/// other (jackknife). Infinite with one participant. Precondition: at least one.
MeanInterval information_interval(std::span<const ConfusionMatrix> participants);

}  // namespace tangent::analysis
