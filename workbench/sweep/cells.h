// The cells of a plan, numbered: a mesh, a motion, a finger, a method and a value for every range. The number alone
// says which, so that any process can solve any part of a plan.
#pragma once

#include "workbench/sweep/plan.h"

#include <cstdint>
#include <vector>

namespace tangent::sweep {

struct Cell {
  std::uint64_t index = 0;
  std::size_t mesh = 0, poses = 0, finger = 0, method = 0;  ///< indices into the plan's lists
  std::vector<double> values;                               ///< one a range
};

class Cells {
 public:
  /// Precondition: check_plan holds. Fails where there are more than 10^12.
  static Result<Cells> of(const Plan& plan);

  std::uint64_t size() const { return groups_ * per_group_; }
  /// Cells of one mesh, motion and finger follow each other.
  std::uint64_t per_group() const { return per_group_; }
  Cell at(std::uint64_t index) const;  ///< precondition: index < size()
  Preset preset(const Cell& cell) const;
  const Plan& plan() const { return plan_; }

 private:
  explicit Cells(const Plan& plan) : plan_(plan) {}
  std::vector<double> values(std::uint64_t sample) const;

  Plan plan_;
  std::uint64_t groups_ = 0, per_group_ = 0, samples_ = 0;
  std::vector<std::vector<double>> grids_;  ///< a grid's values, by range
  std::vector<std::vector<double>> drawn_;  ///< of another sampling: by sample, the values
};

}  // namespace tangent::sweep
