#include "workbench/bench/speed_curves.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tangent::bench {
namespace {

std::vector<CurveSetting> settings_of(const SpeedCurvesOptions& options) {
  std::vector<CurveSetting> out;
  for (const Method method : options.methods) {
    out.push_back({method, Swept::nothing, 0.0, 0});
    if (!is_smooth(method)) continue;  // facet, force shading and the two passes have nothing to iterate
    for (const double tolerance : options.tolerances_m) out.push_back({method, Swept::tolerance, tolerance, 0});
    for (const int limit : options.limits) out.push_back({method, Swept::iterations, 0.0, limit});
  }
  return out;
}

/// The values that the setting takes from the preset, for whoever reads it.
CurveSetting said_in_full(const CurveSetting& setting, const Preset& preset) {
  const SolverSettings solver = with_setting(preset, setting).solver;
  return {setting.method, setting.swept, solver.tolerance_m, solver.max_iterations};
}

/// One query at every pose. A scene's first part is that of its peers.
std::vector<double> ask_all(PeerQuery& query, std::span<const MotionPart> parts, const TickClock& clock,
                            const Stop& stop, std::vector<PeerAnswer>& answers) {
  constexpr std::size_t kStopQueries = 256;
  std::vector<double> ns;
  answers.clear();  // stored, so that the compiler can't remove a query
  for (const MotionPart& part : parts) {
    for (const TickInput& pose : part.poses) {
      if (ns.size() % kStopQueries == 0 && stop()) return {};
      const Vec3 centre = pose.finger.position - part.scene->mesh().origin();
      const std::int64_t from = clock.mark();
      answers.push_back(query.ask(centre));
      const std::int64_t to = clock.mark();
      ns.push_back(clock.elapsed_ns(from, to));
    }
  }
  return ns;
}

/// Its answers beside the exact contacts.
void add_peer_errors(std::span<const MotionPart> parts, const ExactRun& exact, std::span<const PeerAnswer> answers,
                     CurvePeer& peer) {
  std::vector<double> errors;
  double worst_m = -1.0;
  std::size_t i = 0;
  bool round = true;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    round = round && is_round(parts[p].preset.finger);
    for (std::size_t k = 0; k < parts[p].poses.size(); ++k, ++i) {
      if (!answers[i].found) continue;
      ++peer.answered;
      if (!is_converged(exact[p][k].status)) continue;
      const Vec3 d = parts[p].scene->mesh().origin() + answers[i].point - exact[p][k].contact;
      errors.push_back(std::sqrt(glm::dot(d, d)));
      if (errors.back() <= worst_m) continue;
      worst_m = errors.back();
      peer.worst = {p, k};
    }
  }
  if (round) peer.error_m = distribution(std::move(errors));
}

class Measurement {
 public:
  Measurement(std::span<const MotionPart> parts, const TickClock& clock, const SpeedCurvesOptions& options)
      : parts_(parts), clock_(clock), options_(options), settings_(settings_of(options)) {
    out_.seed = options.seed;
    out_.clock_overhead_ns = clock.overhead_ns();
    for (const MotionPart& part : parts) out_.ticks += part.poses.size();
  }
  std::uint64_t ticks() const { return out_.ticks; }

  /// False: stopped.
  bool take_errors() {
    const std::optional<ExactRun> exact = exact_run(parts_, options_.stop);
    if (!exact || !take_peers(*exact)) return false;
    planned_ = settings_.size() + 2 * competitors() * static_cast<std::size_t>(options_.rounds);
    for (const CurveSetting& setting : settings_) {
      const auto errors = tick_errors(parts_, *exact, applied(setting), options_.stop);
      if (!errors) return false;
      out_.points.push_back({said_in_full(setting, parts_.front().preset), summary_of(*errors), {}});
      step();
    }
    return true;
  }

  std::optional<SpeedCurves> take_times() {
    std::vector<TimedPass> passes;
    for (const CurveSetting& setting : settings_)
      passes.push_back(solving_pass(parts_, applied(setting), clock_, options_.stop));
    for (const CurvePeer& peer : out_.peers)
      passes.push_back(
          [this, query = peer.peer.query] { return ask_all(*query, parts_, clock_, options_.stop, answers_); });
    Turns turns(std::move(passes), {.seed = options_.seed, .there_and_back = true});
    turns.after_pass = [this] { step(); };
    const std::int64_t began = TickClock::now();
    while (turns.rounds() < options_.rounds) {
      const double seconds = 1e-9 * static_cast<double>(TickClock::now() - began);
      if (turns.rounds() >= kLeastRounds && seconds > options_.most_s) break;
      if (!turns.round()) break;
      fill_in(turns);
      options_.after_round(out_);
    }
    return turns.rounds() > 0 ? std::optional(std::move(out_)) : std::nullopt;
  }

 private:
  static std::function<Preset(const Preset&)> applied(const CurveSetting& setting) {
    return [setting](const Preset& preset) { return with_setting(preset, setting); };
  }
  std::size_t competitors() const { return settings_.size() + out_.peers.size(); }
  void step() {
    ++done_;
    options_.progress(done_, std::max(done_, planned_));
  }

  /// Those of one scene: a motion over several is none that they can be set up for.
  bool take_peers(const ExactRun& exact) {
    const bool one_scene =
        std::all_of(parts_.begin(), parts_.end(), [&](const MotionPart& p) { return p.scene == parts_.front().scene; });
    if (!options_.peers || !one_scene) return true;
    const MotionPart& first = parts_.front();
    for (Peer& peer : make_peers(*first.scene, first.preset.finger.reach_m())) {
      CurvePeer& added = out_.peers.emplace_back();
      added.peer = std::move(peer);
      if (ask_all(*added.peer.query, parts_, clock_, options_.stop, answers_).empty()) return false;
      add_peer_errors(parts_, exact, answers_, added);
    }
    return true;
  }

  void fill_in(const Turns& turns) {
    for (std::size_t i = 0; i < out_.points.size(); ++i) out_.points[i].times = times_of(turns.of(i));
    for (std::size_t i = 0; i < out_.peers.size(); ++i) out_.peers[i].times = times_of(turns.of(settings_.size() + i));
    out_.rounds = turns.rounds();
    out_.coverage = out_.points.front().times.mean_ns.coverage;
    out_.levels.clear();
    constexpr std::array kLevels{1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
    for (const double level : kLevels) add_level(turns, level);
  }

  void add_level(const Turns& turns, double level_m) {
    // Not 0: where the surface offers no contact, no method finds one.
    const std::uint64_t fewest = std::min_element(out_.points.begin(), out_.points.end(), [](auto& a, auto& b) {
                                   return a.errors.unconverged < b.errors.unconverged;
                                 })->errors.unconverged;
    std::vector<std::size_t> good;
    for (const Method method : options_.methods) {
      std::vector<std::size_t> its;
      for (std::size_t i = 0; i < out_.points.size(); ++i) {
        const CurvePoint& point = out_.points[i];
        const bool enough =
            point.errors.unconverged == fewest && point.errors.error_m.count > 0 && point.errors.error_m.p99 <= level_m;
        if (point.setting.method == method && enough) its.push_back(i);
      }
      if (!its.empty()) good.push_back(ranked(turns, its).front().competitor);
    }
    if (good.empty()) return;
    ErrorLevel& level = out_.levels.emplace_back();
    level.error_m = level_m;
    for (const BesideFastest& one : ranked(turns, good))
      level.methods.push_back({one.competitor, one.to_fastest, one.tie});
  }

  std::span<const MotionPart> parts_;
  const TickClock& clock_;
  const SpeedCurvesOptions& options_;
  std::vector<CurveSetting> settings_;
  std::vector<PeerAnswer> answers_;
  std::size_t done_ = 0, planned_ = 0;
  SpeedCurves out_;
};

}  // namespace

Preset with_setting(Preset preset, const CurveSetting& setting) {
  preset.solver.method = setting.method;
  if (setting.swept == Swept::tolerance) {
    preset.solver.tolerance_m = setting.tolerance_m;
    preset.solver.max_iterations = std::max(preset.solver.max_iterations, kLastIterations);
  }
  if (setting.swept == Swept::iterations) preset.solver.max_iterations = setting.max_iterations;
  return preset;
}

std::optional<SpeedCurves> measure_speed_curves(std::span<const MotionPart> parts, const TickClock& clock,
                                                const SpeedCurvesOptions& options) {
  Measurement measurement(parts, clock, options);
  if (measurement.ticks() == 0 || options.methods.empty() || !measurement.take_errors()) return std::nullopt;
  return measurement.take_times();
}

}  // namespace tangent::bench
