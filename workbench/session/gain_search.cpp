#include "workbench/session/gain_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tangent {

bool shows_better(const RunScore& now, const RunScore& other) {
  if (other.unconverged != now.unconverged) return other.unconverged < now.unconverged;
  return std::round(100.0 * other.mean_iterations()) < std::round(100.0 * now.mean_iterations());
}

GainSearch::~GainSearch() { cancel(); }

void GainSearch::cancel() {
  stop_.store(true);
  if (thread_.joinable()) thread_.join();
  running_.store(false);
}

void GainSearch::start(std::shared_ptr<const ContactScene> scene, const Preset& preset, std::vector<TickInput> poses,
                       std::uint64_t last_tick, bool threaded) {
  cancel();
  if (poses.size() > kMostPoses) poses.erase(poses.begin(), poses.end() - static_cast<std::ptrdiff_t>(kMostPoses));
  if (poses.empty()) return;
  GainSearchResult asked;
  asked.base = preset;
  asked.base.solver.method = Method::paper;
  asked.first_tick = last_tick + 1 - poses.size();
  asked.last_tick = last_tick;
  stop_.store(false);
  progress_.store(0.0);
  running_.store(true);
  if (!threaded) return work(scene, asked, poses);
  thread_ = std::thread([this, scene = std::move(scene), asked = std::move(asked), poses = std::move(poses)] {
    work(scene, asked, poses);
  });
}

void GainSearch::work(const std::shared_ptr<const ContactScene>& scene, const GainSearchResult& asked,
                      const std::vector<TickInput>& poses) {
  auto out = std::make_shared<GainSearchResult>(asked);
  Stepper stepper(scene);
  out->now = score_run(stepper, asked.base, poses, [this](const RunScore&) { return !stop_.load(); });
  const double reach = asked.base.finger.reach_m();
  const GainGrid grid = make_gain_grid(reach > 0.0 ? reach : 0.01);
  const GainTuning tuning = tune_gains(scene, asked.base, poses, grid, [this](std::size_t done, std::size_t planned) {
    progress_.store(planned > 0 ? static_cast<double>(done) / static_cast<double>(planned) : 0.0);
    return !stop_.load();
  });
  if (!tuning.stopped && !tuning.best.empty()) {
    out->best = tuning.best.front();
    const std::scoped_lock lock(guard_);
    result_ = std::move(out);
  }
  running_.store(false);
}

std::shared_ptr<const GainSearchResult> GainSearch::result() const {
  const std::scoped_lock lock(guard_);
  return result_;
}

}  // namespace tangent
