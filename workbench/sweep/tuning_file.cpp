#include "workbench/sweep/tuning_file.h"

#include "workbench/sweep/tuning_lines.h"

namespace tangent::sweep {
namespace {

/// What a power cut can cost.
constexpr auto kFlushEvery = std::chrono::milliseconds(500);

LineFileRules tuning_rules() {
  return {.damaged = "remove it: the tuning then begins anew",
          .append = {.not_whole = "make room; the same command goes on from there",
                     .in_use = "wait until that tuning has ended, or choose another --out"}};
}

std::array<double, 3> key_of(const Gains& gains) { return {gains.overall, gains.curvature_m, gains.distance_per_m}; }

}  // namespace

Result<std::unique_ptr<TuningFile>> TuningFile::open(const std::filesystem::path& path, const std::string& digest) {
  std::unique_ptr<TuningFile> out(new TuningFile);
  out->path_ = path;
  bool named = false;
  const auto take = [&](std::string_view text, std::uint64_t number) {
    named = true;
    return out->take(text, number, digest);
  };
  Result<LineFile> file = LineFile::open(path, take, tuning_rules());
  if (!file) return tl::unexpected(file.error());
  out->file_.emplace(std::move(*file));
  out->found_ = out->trials_.size() + out->scores_.size();
  if (!named)
    if (Status ok = out->file_->add(tuning_name_line(digest)); !ok) return tl::unexpected(ok.error());
  return out;
}

TuningFile::~TuningFile() {
  if (file_ && found_ == 0 && !kept_any_) remove();
}

Status TuningFile::take(std::string_view text, std::uint64_t number, const std::string& digest) {
  if (number == 1) {
    if (is_tuning_name_line(text, digest)) return {};
    return fail("keeps what another tuning tried (of other options, meshes, poses, or by another program)",
                path_.string(), "go on with that one, remove the file, or choose another --out");
  }
  TuningLine line;
  if (!parse_tuning_line(text, line)) return LineFile::damaged(path_, number, tuning_rules());
  if (auto* const trial = std::get_if<NumberedTrial>(&line))
    trials_.insert_or_assign(trial->number, std::move(trial->trial));
  else if (const auto* const scored = std::get_if<GainTrial>(&line))
    scores_.insert_or_assign(key_of(scored->gains), scored->score);
  else
    scales_ = std::get<std::vector<TimeScale>>(line);
  return {};
}

const RacedTrial* TuningFile::trial(std::size_t number, const std::vector<double>& values) const {
  const auto at = trials_.find(number);
  return at != trials_.end() && at->second.trial.values == values ? &at->second : nullptr;
}

const RunScore* TuningFile::score(const Gains& gains) const {
  const auto at = scores_.find(key_of(gains));
  return at != scores_.end() ? &at->second : nullptr;
}

void TuningFile::add(const std::string& text) {
  const std::scoped_lock lock(guard_);
  if (!status_) return;
  status_ = file_->add(text);
  kept_any_ = kept_any_ || status_;
  const auto now = std::chrono::steady_clock::now();
  if (!status_ || now - flushed_ < kFlushEvery) return;
  flushed_ = now;
  status_ = file_->flush();
}

void TuningFile::keep(std::size_t number, const RacedTrial& trial) { add(trial_line(number, trial)); }
void TuningFile::keep(const Gains& gains, const RunScore& score) { add(gains_line({gains, score})); }

void TuningFile::keep(const std::vector<FrontGround>& grounds) {
  std::vector<TimeScale> scales;
  for (const FrontGround& on : grounds) scales.push_back(on.scale);
  add(scales_line(scales));
}

bool TuningFile::failed() const { return !status(); }

Status TuningFile::status() const {
  const std::scoped_lock lock(guard_);
  return status_;
}

void TuningFile::remove() {
  if (removed_) return;
  removed_ = true;
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace tangent::sweep
