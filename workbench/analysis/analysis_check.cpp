#include "workbench/analysis/analysis_check.h"

#include "workbench/analysis/confusion.h"
#include "workbench/analysis/psychometric_fit.h"
#include "workbench/experiment/order.h"
#include "workbench/experiment/participant.h"
#include "workbench/experiment/simulated_group.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

namespace tangent::analysis {
namespace {

using namespace experiment;

/// Seconds since it was asked last.
class LapWatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

CheckRow mean_row(const std::string& what, const std::string& unit, const std::vector<double>& values) {
  const MeanInterval m = mean_interval(values);
  return {what, unit, m.count, m.mean, m.low(), m.high()};
}
/// exp of the mean of logarithms.
CheckRow ratio_row(const std::string& what, const std::vector<double>& logs, double expected) {
  const MeanInterval m = mean_interval(logs);
  return {what, "", m.count, std::exp(m.mean), std::exp(m.low()), std::exp(m.high()), expected};
}
CheckRow share_row(const std::string& what, std::uint64_t of, std::uint64_t count, double expected) {
  const RatioInterval share = share_interval(of, count);
  return {what, "%", count, 100.0 * share.ratio, 100.0 * share.low, 100.0 * share.high, expected};
}

class Checks {
 public:
  Checks(const Protocol& protocol, int participants, const std::function<bool()>& stop)
      : protocol_(protocol), participants_(participants), stop_(stop) {}
  bool stopped() const { return stop_ && stop_(); }
  void add(CheckRow row) {
    row.seconds = watch_.lap();
    rows_.push_back(std::move(row));
  }
  std::vector<CheckRow> rows() && { return std::move(rows_); }

  void compare() {
    through_comparisons();
    balance();
    ThresholdFitter first(rule(), std::clamp(participants_, 20, 4000), stop_);
    for (const Begun begun : kAllBegun)
      for (const auto& [from, to] : kBands) thresholds(first, from, to, begun);
    other_rules();
    for (const double spread : {0.1, 0.2, 0.35, 0.5, 1.0}) spreads(first, spread);
  }
  void name() {
    const KnownNamer namer = namer_like_the_papers(*protocol_.identification());
    const std::vector<ConfusionMatrix> all = through_namings(namer);
    if (!stopped()) information(namer, all);
  }

 private:
  static constexpr std::array<std::pair<double, double>, 3> kBands{{{0.1, 0.2}, {0.2, 0.5}, {0.5, 1.0}}};
  static constexpr double kLapse = 0.02;
  /// Where staircases begin: at half to an eighth of the threshold's segments, at it, at twice as many.
  enum class Begun : std::uint8_t { below, at, above };
  static constexpr std::array kAllBegun{Begun::below, Begun::at, Begun::above};
  const StaircaseRule& rule() const { return protocol_.discrimination()->conditions.front().staircase; }

  /// Everybody through the whole protocol, as the files' rows are made.
  void through_comparisons() {
    std::vector<double> trials, over;
    std::uint64_t settled = 0, staircases = 0;
    for (int p = 1; p <= participants_ && !stopped(); ++p) {
      const auto number = static_cast<std::uint64_t>(p);
      auto run = ComparisonRun::start(protocol_, number, number);
      const KnownComparer participant = comparer_like_the_papers(protocol_, number, number);
      std::map<std::string, std::pair<Staircase, Psychometric>> each;
      for (const ComparisonCondition& c : protocol_.discrimination()->conditions)
        each.emplace(c.name, std::pair{Staircase(c.staircase), participant.functions.at(c.name)});
      take_part(*run, participant, number,
                [&](const ComparisonRow& row) { each.at(row.condition).first.answer(row.right); });
      for (const auto& [condition, one] : each) {
        ++staircases;
        trials.push_back(one.first.trials());
        if (!one.first.settled()) continue;
        ++settled;
        over.push_back(std::log(one.first.threshold() / one.second.segments_at(balance_point(rule()))));
      }
    }
    add(share_row("staircases of the protocol that settle", settled, staircases, kNothingAsked));
    add(mean_row("trials of a staircase", "", trials));
    add(ratio_row("rule's mean of reversals over the threshold, geometric mean", over, kNothingAsked));
  }

  /// Small steps, begun at the threshold, long: where up and down balance.
  void balance() {
    StaircaseRule small = rule();
    small.scale = StepScale::ratio;
    small.large_step = small.small_step = 1.01;
    small.reversals = 400;
    small.most_trials = 100'000;
    small.start = 100.0;
    small.most = 1e6;
    std::vector<double> shares;
    for (int p = 0; p < std::max(participants_ / 50, 2) && !stopped(); ++p) {
      Psychometric function{1.0, 0.35, kLapse};
      function.middle = small.start / function.segments_at(balance_point(small));
      SplitMix random(2, static_cast<std::uint64_t>(p));
      Staircase staircase(small);
      double right = 0.0;
      while (!staircase.done()) {
        const bool answer = random.unit() < function.right(staircase.segments());
        right += answer;
        staircase.answer(answer);
      }
      shares.push_back(100.0 * right / staircase.trials());
    }
    CheckRow row = mean_row("right answers where steps of 1 % settle", "%", shares);
    row.expected = 100.0 * balance_point(small);
    add(row);
  }

  Psychometric of_spread(const StaircaseRule& of, double spread, Begun begun, SplitMix& random) const {
    Psychometric out{1.0, spread, kLapse};
    double over = 1.0;
    if (begun == Begun::below) over = 2.0 * std::pow(4.0, random.unit());
    if (begun == Begun::above) over = 0.5;
    out.middle = over * of.start / out.segments_at(balance_point(of));
    return out;
  }

  struct Fitted {
    std::uint64_t held = 0;
    std::vector<double> off, rule_off;  ///< logarithms: fit and rule less the truth
  };
  Fitted fit_all(ThresholdFitter& fitter, double from, double to, Begun begun) {
    Fitted out;
    for (int i = 0; i < participants_ && !stopped(); ++i) {
      SplitMix random(3, static_cast<std::uint64_t>(i));
      const Psychometric function = of_spread(fitter.rule(), from + (to - from) * random.unit(), begun, random);
      Staircase staircase(fitter.rule());
      const FittedThreshold fit = fitter.fit(simulated_answers(staircase, function, random));
      const double truth = function.segments_at(balance_point(fitter.rule()));
      out.held += fit.low <= truth && truth <= fit.high;
      out.off.push_back(std::log(fit.segments / truth));
      if (staircase.settled()) out.rule_off.push_back(std::log(staircase.threshold() / truth));
    }
    return out;
  }
  CheckRow held_row(const std::string& of, std::uint64_t held) const {
    return share_row("intervals that hold the threshold" + of, held, static_cast<std::uint64_t>(participants_), 95.0);
  }
  static std::string band(double from, double to, Begun begun) {
    constexpr std::array kWhere{"", ", begun at it", ", begun at twice it"};
    char text[64];
    std::snprintf(text, sizeof text, ", spreads of %.1f to %.1f%s", from, to, kWhere[static_cast<std::size_t>(begun)]);
    return text;
  }

  void thresholds(ThresholdFitter& fitter, double from, double to, Begun begun) {
    if (stopped()) return;
    const Fitted all = fit_all(fitter, from, to, begun);
    const std::string of = band(from, to, begun);
    add(held_row(of, all.held));
    add(ratio_row("fitted threshold over the truth" + of, all.off, 1.0));
    add(ratio_row("rule's mean of reversals over the truth" + of, all.rule_off, kNothingAsked));
  }

  /// Whether intervals hold for the protocol's other conditions, those of one rule once.
  void other_rules() {
    std::vector<StaircaseRule> seen{rule()};
    for (const ComparisonCondition& condition : protocol_.discrimination()->conditions) {
      if (std::find(seen.begin(), seen.end(), condition.staircase) != seen.end()) continue;
      seen.push_back(condition.staircase);
      ThresholdFitter fitter(condition.staircase, std::clamp(participants_, 20, 4000), stop_);
      for (const Begun begun : {Begun::below, Begun::at})  // twice as many as few: below what can be shown
        for (const auto& [from, to] : kBands)
          if (!stopped())
            add(held_row(" of " + condition.name + band(from, to, begun), fit_all(fitter, from, to, begun).held));
    }
  }

  /// Groups of twelve with one spread: whether it is found, and where the rule settles with it.
  void spreads(ThresholdFitter& fitter, double spread) {
    if (stopped()) return;
    constexpr int kGroup = 12, kTold = 20;  // of so many groups the rule's bias is told: each staircase is simulated
    const int groups = std::max(participants_ / 10, 2);
    std::uint64_t held = 0;
    std::vector<double> ratios, rule_off, told;
    for (int g = 0; g < groups && !stopped(); ++g) {
      std::vector<FittedThreshold> all;
      SplitMix random(4, static_cast<std::uint64_t>(g));
      for (int i = 0; i < kGroup; ++i) {
        Staircase staircase(rule());
        const Psychometric function = of_spread(rule(), spread, Begun::below, random);
        all.push_back(fitter.fit(simulated_answers(staircase, function, random)));
        if (staircase.settled())
          rule_off.push_back(std::log(staircase.threshold() / function.segments_at(balance_point(rule()))));
      }
      const SpreadInterval found = fitter.common_spread(all);
      held += found.low <= spread && spread <= found.high;
      ratios.push_back(std::log(found.spread / spread));
      for (const FittedThreshold& one : all)
        if (g < kTold) told.push_back(std::log(fitter.rule_bias(one.segments, found.spread)));
    }
    char of[48];
    std::snprintf(of, sizeof of, " of twelve participants, %.2f", spread);
    add(share_row(std::string("intervals that hold the spread") + of, held, static_cast<std::uint64_t>(groups), 95.0));
    add(ratio_row(std::string("fitted spread over the truth") + of, ratios, 1.0));
    add(ratio_row(std::string("rule's mean of reversals over the truth") + of, rule_off, kNothingAsked));
    add(ratio_row(std::string("the same, as the analysis tells it") + of, told, rows_.back().found));
  }

  std::vector<ConfusionMatrix> through_namings(const KnownNamer& namer) {
    const Identification& design = *protocol_.identification();
    const std::size_t objects = design.objects.size();
    std::vector<ConfusionMatrix> out;
    std::uint64_t right = 0, answers = 0;
    double truth = 0.0;
    for (std::size_t i = 0; i < objects; ++i) truth += 100.0 * namer.shares[i][i] / static_cast<double>(objects);
    const auto at = [&](const std::string& name) {
      return static_cast<std::size_t>(std::find(design.objects.begin(), design.objects.end(), name) -
                                      design.objects.begin());
    };
    std::uint64_t held = 0;
    for (int p = 1; p <= participants_ && !stopped(); ++p) {
      const auto number = static_cast<std::uint64_t>(p);
      ConfusionMatrix& own = out.emplace_back(objects);
      std::vector<NamingRow> rows;
      for (int session = 0; session < design.sessions; ++session) {
        auto run = NamingRun::start(protocol_, number, number, rows);
        take_part(*run, design, namer, number, [&](const NamingRow& row) {
          own.add(at(row.object), at(row.answer));
          rows.push_back(row);
        });
      }
      right += own.right();
      answers += own.total();
      const RatioInterval share = share_interval(own.right(), own.total());
      held += 100.0 * share.low <= truth && truth <= 100.0 * share.high;
    }
    add(share_row("right answers of participants through the protocol", right, answers, truth));
    add(share_row("intervals that hold the share of right answers", held, out.size(), 95.0));
    return out;
  }

  /// Groups of the paper's size.
  void information(const KnownNamer& namer, const std::vector<ConfusionMatrix>& all) {
    constexpr std::size_t kGroup = 18;
    constexpr std::uint64_t kMany = 1'000'000;
    const std::size_t objects = namer.shares.size();
    ConfusionMatrix law(objects);
    for (std::size_t i = 0; i < objects; ++i)
      for (std::size_t j = 0; j < objects; ++j)
        law.add(i, j, static_cast<std::uint64_t>(std::lround(namer.shares[i][j] * kMany)));
    const double truth = information_bits(law);
    std::uint64_t held = 0, groups = 0;
    std::vector<double> counted, corrected;
    // Drawn from everybody: as many groups as participants, and two of them hardly share one.
    for (std::size_t g = 0; g < all.size() && all.size() >= kGroup && !stopped(); ++g) {
      SplitMix random(5, g);
      std::vector<ConfusionMatrix> group;
      for (std::size_t i = 0; i < kGroup; ++i) group.push_back(all[random.below(all.size())]);
      ConfusionMatrix together(objects);
      for (const ConfusionMatrix& one : group) together += one;
      const MeanInterval interval = information_interval(group);
      counted.push_back(information_bits(together));
      corrected.push_back(interval.mean);
      held += interval.low() <= truth && truth <= interval.high();
      ++groups;
    }
    if (groups == 0) return;
    add(share_row("intervals that hold the information, groups of 18", held, groups, 95.0));
    CheckRow row = mean_row("information as counted, groups of 18", "bits", counted);
    row.expected = truth;
    add(row);
    row = mean_row("information, corrected", "bits", corrected);
    row.expected = truth;
    add(row);
  }

  const Protocol& protocol_;
  int participants_;
  const std::function<bool()>& stop_;
  LapWatch watch_;
  std::vector<CheckRow> rows_;
};

}  // namespace

std::vector<CheckRow> check_analysis(const Protocol& protocol, int participants, const std::function<bool()>& stop) {
  Checks checks(protocol, participants, stop);
  protocol.discrimination() ? checks.compare() : checks.name();
  return std::move(checks).rows();
}

}  // namespace tangent::analysis
