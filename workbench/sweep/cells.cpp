#include "workbench/sweep/cells.h"

#include "core/base/split_mix.h"

#include <boost/random/sobol.hpp>

#include <numeric>
#include <span>

namespace tangent::sweep {
namespace {

constexpr std::uint64_t kMostCells = 1'000'000'000'000ull;
constexpr std::uint64_t kMostSamples = 1u << 26;  // their values are kept

using Shares = std::vector<std::vector<double>>;  // by sample, one in [0, 1) a range

Shares random_shares(std::size_t samples, std::size_t ranges, std::uint64_t seed) {
  SplitMix random(seed);
  Shares out(samples, std::vector<double>(ranges));
  for (auto& sample : out)
    for (double& share : sample) share = random.unit();
  return out;
}

Shares latin_shares(std::size_t samples, std::size_t ranges, std::uint64_t seed) {
  SplitMix random(seed);
  Shares out(samples, std::vector<double>(ranges));
  std::vector<std::size_t> parts(samples);
  for (std::size_t r = 0; r < ranges; ++r) {
    std::iota(parts.begin(), parts.end(), std::size_t{0});
    random.shuffle(std::span(parts));
    for (std::size_t i = 0; i < samples; ++i)
      out[i][r] = (static_cast<double>(parts[i]) + random.unit()) / static_cast<double>(samples);
  }
  return out;
}

/// The seed moves all points by one and the same step, around the ends (Cranley, Patterson 1976); 0: none.
Shares sobol_shares(std::size_t samples, std::size_t ranges, std::uint64_t seed) {
  boost::random::sobol engine(ranges);
  SplitMix random(seed);
  std::vector<double> shift(ranges, 0.0);
  if (seed != 0)
    for (double& s : shift) s = random.unit();
  Shares out(samples, std::vector<double>(ranges));
  for (auto& sample : out) {
    for (std::size_t r = 0; r < ranges; ++r) {
      const double share = static_cast<double>(engine() >> 11) * 0x1p-53 + shift[r];
      sample[r] = share >= 1.0 ? share - 1.0 : share;
    }
  }
  return out;
}

Shares shares_of(const Plan& plan) {
  const std::size_t ranges = plan.ranges.size();
  switch (plan.sampling) {
    case Sampling::random:
      return random_shares(plan.samples, ranges, plan.seed);
    case Sampling::latin_hypercube:
      return latin_shares(plan.samples, ranges, plan.seed);
    default:
      return sobol_shares(plan.samples, ranges, plan.seed);
  }
}

}  // namespace

Result<Cells> Cells::of(const Plan& plan) {
  Cells out(plan);
  const auto too_many = [] {
    return fail("more cells than 10^12", "plan", "shorten the ranges, or draw samples instead of a grid");
  };
  out.samples_ = 1;
  if (plan.sampling == Sampling::grid) {
    for (const Range& range : plan.ranges) {
      out.grids_.push_back(range.grid());
      out.samples_ *= out.grids_.back().size();
      if (out.samples_ > kMostCells) return too_many();
    }
  } else {
    if (plan.samples > kMostSamples) return too_many();
    out.samples_ = plan.samples;
    for (const std::vector<double>& shares : shares_of(plan)) {
      std::vector<double> values;
      for (std::size_t r = 0; r < shares.size(); ++r) values.push_back(plan.ranges[r].at(shares[r]));
      out.drawn_.push_back(std::move(values));
    }
  }
  out.per_group_ = out.samples_ * plan.methods.size();
  out.groups_ = plan.meshes.size() * plan.poses.size() * plan.fingers.size();
  if (out.per_group_ > kMostCells / out.groups_) return too_many();
  return out;
}

std::vector<double> Cells::values(std::uint64_t sample) const {
  if (!drawn_.empty()) return drawn_[sample];
  std::vector<double> out(grids_.size());
  for (std::size_t r = grids_.size(); r-- > 0;) {  // the last range changes fastest
    out[r] = grids_[r][sample % grids_[r].size()];
    sample /= grids_[r].size();
  }
  return out;
}

Cell Cells::at(std::uint64_t index) const {
  Cell cell;
  cell.index = index;
  cell.values = values(index % samples_);
  cell.method = index / samples_ % plan_.methods.size();
  std::uint64_t group = index / per_group_;
  cell.finger = group % plan_.fingers.size();
  group /= plan_.fingers.size();
  cell.poses = group % plan_.poses.size();
  cell.mesh = group / plan_.poses.size();
  return cell;
}

Preset Cells::preset(const Cell& cell) const {
  Preset out = plan_.base;
  out.solver.method = plan_.methods[cell.method];
  out.finger = plan_.fingers[cell.finger];
  for (std::size_t r = 0; r < cell.values.size(); ++r) plan_.ranges[r].key->set(out, cell.values[r]);
  return out;
}

}  // namespace tangent::sweep
