#include "workbench/sweep/trial_run.h"

#include "workbench/sweep/cell_meter.h"

#include <algorithm>
#include <deque>

namespace tangent::sweep {
namespace {

bool needs_circles(const FrontPlan& plan) {
  const auto is = [](const Objective& o) { return o.name() == "closed_work_share" || o.name() == "loops"; };
  return std::any_of(plan.objectives.begin(), plan.objectives.end(), is) ||
         std::any_of(plan.constraints.begin(), plan.constraints.end(), [&](const Constraint& c) { return is(c.of); });
}

std::vector<TickSpan> searched_ticks(const std::vector<FrontGround>& grounds) {
  std::vector<TickSpan> out;
  for (const FrontGround& on : grounds) out.push_back({0, std::min(on.ticks, on.ground.motion->size())});
  return out;
}

double missed_by(double value, double most) {
  return value <= most ? 0.0 : most > 0.0 ? (value - most) / most : value - most;
}

/// Objectives over the grounds, and how far constraints are missed, from each ground's numbers; of grounds without
/// ticks nothing.
void add_up(const FrontPlan& plan, const std::vector<FrontGround>& grounds, const std::vector<CellNumbers>& numbers,
            Trial& trial) {
  trial.objectives.assign(plan.objectives.size(), 0.0);
  trial.ground_numbers = numbers;
  double met = 0.0;
  for (std::size_t g = 0; g < grounds.size(); ++g) {
    if (numbers[g].ticks == 0) continue;
    if (met++ == 0.0) trial.numbers = numbers[g];
    for (std::size_t k = 0; k < plan.objectives.size(); ++k) {
      const double value = plan.objectives[k].of(numbers[g]);
      trial.missed += plan.objectives[k].lacking(numbers[g]);
      double& all = trial.objectives[k];
      all = plan.over_grounds == OverGrounds::worst ? std::max(all, value) : all + (value - all) / met;
    }
    for (const Constraint& constraint : plan.constraints)
      trial.missed += constraint.missed(numbers[g], grounds[g].scale);
  }
}

}  // namespace

Preset on_ground(Preset preset, const FrontGround& on) {
  if (on.finger) preset.finger = *on.finger;
  return preset;
}

struct TrialRun::Parts {
  const FrontPlan& plan;
  const std::vector<FrontGround>& grounds;
  std::vector<Block> blocks;
  std::vector<std::size_t> blocks_of_ground;
  Race rules;
  bool circles;
  struct Steppers {
    Stepper stepper, exact;
  };
  std::vector<std::pair<const ContactScene*, std::unique_ptr<Steppers>>> steppers;

  Parts(const FrontPlan& p, const std::vector<FrontGround>& g)
      : plan(p),
        grounds(g),
        blocks(blocks_of(searched_ticks(g))),
        blocks_of_ground(g.size(), 0),
        rules(g.size(), blocks.size()),
        circles(needs_circles(p)) {
    for (const Block& block : blocks) ++blocks_of_ground[block.ground];
  }

  /// Grounds of one scene share them: what a stepper keeps changes no bit.
  Steppers& steppers_of(std::size_t ground) {
    const auto& scene = grounds[ground].ground.scene;
    for (auto& [of, kept] : steppers)
      if (of == scene.get()) return *kept;
    steppers.emplace_back(scene.get(), new Steppers{Stepper(scene), Stepper(scene)});
    return *steppers.back().second;
  }
};

/// One preset under way.
class TrialRun::Attempt {
 public:
  Attempt(Parts& parts, const Preset& preset) : parts_(parts), plan_(parts.plan) {
    const std::size_t grounds = parts.grounds.size();
    out_.costs.resize(grounds);
    ticks_.resize(grounds, 0.0);
    so_far_.assign(grounds, std::vector<double>(plan_.constraints.size(), 0.0));
    for (std::size_t g = 0; g < grounds; ++g) {
      Parts::Steppers& steppers = parts.steppers_of(g);
      presets_.push_back(on_ground(preset, parts.grounds[g]));
      meters_.emplace_back(steppers.stepper, steppers.exact, presets_.back());
    }
  }

  /// False: told to stop.
  bool see(const Block& block) {
    const std::span<const TickInput> motion(*parts_.grounds[block.ground].ground.motion);
    const auto numbers =
        meters_[block.ground].run(motion.subspan(block.first, block.count), circles(block.ground), plan_.stop);
    if (!numbers) return false;
    std::vector<double>& costs = out_.costs[block.ground].emplace_back();
    for (const Objective& objective : plan_.objectives) costs.push_back(objective.of(*numbers));
    for (std::size_t c = 0; c < plan_.constraints.size(); ++c) {
      const Objective& of = plan_.constraints[c].of;
      costs.push_back(of.of(*numbers, parts_.grounds[block.ground].scale));
      double& value = so_far_[block.ground][c];
      value = of.column->field.index() == 0 ? value + costs.back() : std::max(value, costs.back());
    }
    ticks_[block.ground] += static_cast<double>(block.count);
    out_.trial.ticks += block.count;
    return true;
  }

  /// Whether more ticks are of no use: a constraint is missed for good, or surely, on the ground seen last, or a rival
  /// is surely better in everything.
  bool is_out(std::size_t ground, const Rivals& rivals) {
    out_.trial.dropped = misses(ground) || is_beaten(rivals);
    return out_.trial.dropped;
  }

  RacedTrial done() {
    std::vector<CellNumbers> numbers;
    for (const CellMeter& meter : meters_) numbers.push_back(meter.total());
    add_up(plan_, parts_.grounds, numbers, out_.trial);
    if (!out_.trial.dropped) return std::move(out_);
    if (beaten_by_ != nullptr)  // as bad as who beat it at least, so that it is on no front
      for (std::size_t k = 0; k < plan_.objectives.size(); ++k)
        out_.trial.objectives[k] = std::max(out_.trial.objectives[k], beaten_by_->objectives[k]);
    out_.trial.missed = std::max(out_.trial.missed, missed_);
    return std::move(out_);
  }

 private:
  std::size_t circles(std::size_t ground) const {
    const std::size_t all = parts_.blocks_of_ground[ground], seen = out_.costs[ground].size();
    return !parts_.circles || seen >= kCircles ? 0 : std::max<std::size_t>(1, kCircles / all);
  }

  /// Counts are taken to go on as they have begun, so that trials that ended at different blocks compare.
  bool misses(std::size_t ground) {
    const FrontGround& on = parts_.grounds[ground];
    for (std::size_t c = 0; c < plan_.constraints.size(); ++c) {
      const Constraint& constraint = plan_.constraints[c];
      const NumberColumn& column = *constraint.of.column;
      double value = so_far_[ground][c];
      if (!column.grows) {
        std::vector<double> values;
        for (const auto& costs : out_.costs[ground]) values.push_back(costs[plan_.objectives.size() + c]);
        if (!parts_.rules.above(values, constraint.most)) continue;
        for (const double v : values) missed_ += missed_by(v, constraint.most) / static_cast<double>(values.size());
        return true;
      }
      if (value <= constraint.most) continue;
      if (column.field.index() == 0) value *= static_cast<double>(on.ticks) / ticks_[ground];
      missed_ = missed_by(value, constraint.most);
      return true;
    }
    return false;
  }

  bool is_beaten(const Rivals& rivals) {
    for (const RacedTrial& rival : rivals) {
      if (!parts_.rules.beaten(out_.costs, rival.costs, plan_.objectives.size())) continue;
      beaten_by_ = &rival.trial;
      return true;
    }
    return false;
  }

  Parts& parts_;
  const FrontPlan& plan_;
  std::deque<Preset> presets_;  // each stays where it is
  std::vector<CellMeter> meters_;
  std::vector<std::vector<double>> so_far_;  // by ground and constraint: sums of counts, largest of the others
  std::vector<double> ticks_;
  const Trial* beaten_by_ = nullptr;
  double missed_ = 0.0;
  RacedTrial out_;
};

TrialRun::TrialRun(const FrontPlan& plan, const std::vector<FrontGround>& grounds)
    : parts_(std::make_unique<Parts>(plan, grounds)) {}

TrialRun::~TrialRun() = default;

std::size_t TrialRun::block_count() const { return parts_->blocks.size(); }

RacedTrial TrialRun::race(const Preset& preset, const Rivals* rivals) {
  Attempt attempt(*parts_, preset);
  for (const Block& block : parts_->blocks) {
    if (!attempt.see(block)) return {};
    if (rivals != nullptr && attempt.is_out(block.ground, *rivals)) break;
  }
  return attempt.done();
}

Trial TrialRun::judge(const Preset& preset) {
  std::vector<CellNumbers> numbers(parts_->grounds.size());
  Trial out;
  for (std::size_t g = 0; g < numbers.size(); ++g) {
    const FrontGround& on = parts_->grounds[g];
    const auto motion = std::span(*on.ground.motion).subspan(std::min(on.ticks, on.ground.motion->size()));
    if (motion.empty()) continue;
    Parts::Steppers& steppers = parts_->steppers_of(g);
    const auto measured =
        measure_cell(steppers.stepper, steppers.exact, on_ground(preset, on), motion, parts_->plan.stop);
    if (!measured) return {};
    numbers[g] = *measured;
    out.ticks += motion.size();
  }
  add_up(parts_->plan, parts_->grounds, numbers, out);
  return out;
}

}  // namespace tangent::sweep
