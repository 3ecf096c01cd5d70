// Tunes the gains of Eq. 1 on recorded poses (core/lab/gains/gain_tuning.h) in a background thread, and says whether
// what it found is better than the current gains by the numbers that are shown.
#pragma once

#include "core/lab/gains/gain_tuning.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace tangent {

struct GainSearchResult {
  Preset base;  ///< with the current gains, method paper
  std::uint64_t first_tick = 0, last_tick = 0;
  RunScore now;    ///< of the current gains
  GainTrial best;  ///< the best found
};
/// Better as it is shown: fewer ticks without convergence, or as many and a smaller mean, in hundredths of a plane.
bool shows_better(const RunScore& now, const RunScore& other);

class GainSearch {
 public:
  /// At most this many poses are used, the newest.
  static constexpr std::size_t kMostPoses = 4000;

  ~GainSearch();
  /// Cancels what runs. `poses`: consecutive recorded inputs. `threaded` false: within this call.
  void start(std::shared_ptr<const ContactScene> scene, const Preset& preset, std::vector<TickInput> poses,
             std::uint64_t last_tick, bool threaded);
  void cancel();
  bool running() const { return running_.load(); }
  double progress() const { return progress_.load(); }
  std::shared_ptr<const GainSearchResult> result() const;  ///< of the last search that ended; null: none

 private:
  void work(const std::shared_ptr<const ContactScene>& scene, const GainSearchResult& asked,
            const std::vector<TickInput>& poses);

  std::atomic<bool> stop_{false}, running_{false};
  std::atomic<double> progress_{0.0};
  mutable std::mutex guard_;
  std::shared_ptr<const GainSearchResult> result_;
  std::thread thread_;
};

}  // namespace tangent
