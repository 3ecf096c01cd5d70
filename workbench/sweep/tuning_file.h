// What a tuning has tried, on disk while it runs: one that was ended (killed, Ctrl-C, a power cut) goes on from there,
// with the same trials as if it had not been. The first line says whose it is: a digest of all that decides what a
// trial gives. Files are those of line_file.h.
#pragma once

#include "core/lab/gains/gain_tuning.h"
#include "workbench/sweep/front_plan.h"
#include "workbench/sweep/line_file.h"
#include "workbench/sweep/trial_run.h"

#include <chrono>
#include <map>
#include <mutex>

namespace tangent::sweep {

/// Of plan, grounds (meshes, motions, fingers) and this build: two searches of one digest try the same.
std::string tuning_digest(const FrontPlan& plan, const std::vector<FrontGround>& grounds);
/// Likewise, of a search for gains (core/lab/gains).
std::string tuning_digest(const Preset& base, const ContactScene& scene, std::span<const TickInput> poses);

class TuningFile {
 public:
  /// Makes the file, or goes on with it. Fails on one of another tuning, on one that is damaged, and while another
  /// process has it, naming it.
  static Result<std::unique_ptr<TuningFile>> open(const std::filesystem::path& path, const std::string& digest);
  TuningFile(const TuningFile&) = delete;
  TuningFile& operator=(const TuningFile&) = delete;
  /// One in which nothing was tried does not stay.
  ~TuningFile();

  const std::filesystem::path& path() const { return path_; }
  std::size_t found() const { return found_; }  ///< trials that were there

  /// The trial of that number if it was tried with these values; null: it was not.
  const RacedTrial* trial(std::size_t number, const std::vector<double>& values) const;
  const RunScore* score(const Gains& gains) const;
  const std::vector<TimeScale>& scales() const { return scales_; }  ///< of the grounds; empty: not measured yet

  // Any thread. After the first failure nothing more is kept, and status() says why.
  void keep(std::size_t number, const RacedTrial& trial);
  void keep(const Gains& gains, const RunScore& score);
  void keep(const std::vector<FrontGround>& grounds);  ///< their scales
  bool failed() const;
  Status status() const;

  /// The tuning has ended: the file is no longer needed.
  void remove();

 private:
  TuningFile() = default;
  Status take(std::string_view text, std::uint64_t number, const std::string& digest);
  void add(const std::string& text);

  std::filesystem::path path_;
  std::optional<LineFile> file_;
  std::map<std::size_t, RacedTrial> trials_;
  std::map<std::array<double, 3>, RunScore> scores_;
  std::vector<TimeScale> scales_;
  std::size_t found_ = 0;
  mutable std::mutex guard_;  ///< of those below, and of writing
  bool removed_ = false, kept_any_ = false;
  Status status_;
  std::chrono::steady_clock::time_point flushed_ = std::chrono::steady_clock::now();
};

}  // namespace tangent::sweep
