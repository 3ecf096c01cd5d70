#include "workbench/bench/curves_job.h"

#include "workbench/session/background_thread.h"

#include <utility>

namespace tangent::bench {

CurvesJob::~CurvesJob() {
  cancel();
  if (thread_.joinable()) thread_.join();
}

void CurvesJob::start(std::vector<MotionPart> parts, SpeedCurvesOptions options, bool threaded) {
  cancel();
  if (thread_.joinable()) thread_.join();
  forget();
  stop_.store(false);
  progress_.store(0.0);
  running_.store(true);
  if (!threaded) return work(parts, std::move(options));
  thread_ = std::thread([this, parts = std::move(parts), options = std::move(options)]() mutable {
    yield_to_servo_and_window();
    work(parts, std::move(options));
  });
}

void CurvesJob::work(const std::vector<MotionPart>& parts, SpeedCurvesOptions options) {
  options.stop = [this] { return stop_.load(); };
  options.progress = [this](std::size_t done, std::size_t planned) {
    progress_.store(planned > 0 ? static_cast<double>(done) / static_cast<double>(planned) : 0.0);
  };
  options.after_round = [this](const SpeedCurves& curves) { publish(curves); };
  const TickClock clock;
  measure_speed_curves(parts, clock, options);
  running_.store(false);
}

void CurvesJob::publish(const SpeedCurves& curves) {
  auto copy = std::make_shared<SpeedCurves>(curves);
  for (CurvePeer& peer : copy->peers) peer.peer.query.reset();  // its tree, and the scene that it reads
  const std::scoped_lock lock(guard_);
  if (!stop_.load()) result_ = std::move(copy);
}

std::shared_ptr<const SpeedCurves> CurvesJob::result() const {
  const std::scoped_lock lock(guard_);
  return result_;
}

void CurvesJob::forget() {
  const std::scoped_lock lock(guard_);
  result_.reset();
}

}  // namespace tangent::bench
