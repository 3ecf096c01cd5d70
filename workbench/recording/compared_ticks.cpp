#include "workbench/recording/compared_ticks.h"

#include "core/preset/schema.h"
#include "workbench/recording/computable_recording.h"
#include "workbench/recording/tick_values.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

class RecordedTicks final : public ComparedTicks {
 public:
  explicit RecordedTicks(TickValues values) : values_(std::move(values)) {}
  static constexpr std::array<std::string_view, 4> kBefore{"status", "finger_x_m", "finger_y_m", "finger_z_m"};
  static std::vector<std::string_view> columns() {
    std::vector<std::string_view> names(kBefore.begin(), kBefore.end());
    names.insert(names.end(), kComparedChannels.begin(), kComparedChannels.end());
    return names;
  }

  Result<bool> next(ComparedTick& tick) override {
    const Result<bool> any = values_.next();
    if (!any || !*any) return any;
    tick.tick = values_.tick();
    tick.status = static_cast<TickStatus>(static_cast<int>(std::clamp(values_[0], 0.0, 5.0)));
    tick.finger = {values_[1], values_[2], values_[3]};
    for (std::size_t i = 0; i < kComparedChannelCount; ++i) tick.values[i] = values_[kBefore.size() + i];
    return true;
  }

 private:
  TickValues values_;
};

class SolvedTicks final : public ComparedTicks {
 public:
  SolvedTicks(Recording recording, RecordedScenes scenes, std::map<std::uint32_t, Preset> presets, TickReader reader,
              std::uint64_t first, std::function<bool()> cancelled)
      : recording_(std::move(recording)),
        scenes_(std::move(scenes)),
        presets_(std::move(presets)),
        reader_(std::move(reader)),
        first_(first),
        cancelled_(std::move(cancelled)) {}

  Result<bool> next(ComparedTick& tick) override {
    do {
      if ((row_.record.tick.tick & 1023u) == 0 && cancelled_()) return false;
      const Result<bool> any = reader_.next(row_);
      if (!any || !*any) return any;
      if (Status ok = solve(tick); !ok) return tl::unexpected(ok.error());
    } while (tick.tick < first_);
    return true;
  }

 private:
  Status solve(ComparedTick& tick) {
    const TickRecord& was = row_.record.tick;
    const auto scene = scenes_.find(row_.record.scene_id);
    const auto preset = presets_.find(was.preset_id);
    if (scene == scenes_.end() || preset == presets_.end())
      return fail("tick " + std::to_string(was.tick) + " names a scene or preset that is not there",
                  recording_.path().string(), "the file is damaged: copy it from where it was recorded again");
    if (!stepper_ || &stepper_->scene() != scene->second.get()) {
      stepper_.emplace(scene->second);
      state_ = {};
    }
    const TickOutput out = stepper_->step(preset->second, was.input, state_);
    tick.tick = was.tick;
    tick.status = out.status;
    tick.finger = was.input.finger.position;
    tick.values = {out.force_n.x, out.force_n.y, out.force_n.z,     out.cld_m,   out.contact.x,
                   out.contact.y, out.contact.z, out.penetration_m, out.error_m, static_cast<double>(out.iterations)};
    return {};
  }

  Recording recording_;
  RecordedScenes scenes_;
  std::map<std::uint32_t, Preset> presets_;
  TickReader reader_;
  std::uint64_t first_;
  std::function<bool()> cancelled_;
  RecordedTick row_;
  std::optional<Stepper> stepper_;
  TickState state_;
};

bool touches(TickStatus status) {
  return status == TickStatus::face || status == TickStatus::edge || status == TickStatus::vertex;
}

}  // namespace

Result<std::unique_ptr<ComparedTicks>> recorded_ticks(const std::filesystem::path& path, std::uint64_t first,
                                                      std::uint64_t last) {
  Result<TickValues> values = TickValues::open(path, RecordedTicks::columns(), first, last);
  if (!values) return tl::unexpected(values.error());
  return std::make_unique<RecordedTicks>(std::move(*values));
}

Result<std::unique_ptr<ComparedTicks>> solved_ticks(const std::filesystem::path& path, const OtherPreset& how,
                                                    const TickSpan& span, std::function<bool()> cancelled) {
  Result<Recording> recording = Recording::open(path);
  if (!recording) return tl::unexpected(recording.error());
  Result<RecordedScenes> scenes = scenes_of(*recording, how.mesh ? how.mesh : how.scene);
  if (!scenes) return tl::unexpected(scenes.error());
  if (how.mesh)
    for (auto& [id, scene] : *scenes) scene = how.mesh;
  std::map<std::uint32_t, Preset> presets;
  for (const auto& [id, preset] : recording->presets()) {
    presets[id] = how.other(preset);
    if (Status ok = check_preset(presets[id]); !ok) return tl::unexpected(ok.error());
  }
  Result<TickReader> reader = recording->ticks(recording->info().first_tick, span.last);
  if (!reader) return tl::unexpected(reader.error());
  return std::make_unique<SolvedTicks>(std::move(*recording), std::move(*scenes), std::move(presets),
                                       std::move(*reader), span.first, std::move(cancelled));
}

std::vector<QuantityDifference> no_differences(const CompareTolerance& tolerance) {
  std::vector<QuantityDifference> all;
  for (const ComparedQuantity& q : kComparedQuantities)
    all.push_back({.name = q.name, .unit = q.unit, .tolerance = q.tolerance ? tolerance.*q.tolerance : -1.0});
  return all;
}

std::size_t bin_of(const Alignment& alignment, std::uint64_t tick, std::size_t bins) {
  const double share = static_cast<double>(tick - alignment.first) / static_cast<double>(alignment.ticks());
  return std::min(static_cast<std::size_t>(share * static_cast<double>(bins)), bins - 1);
}

std::vector<ComparedBin> empty_bins(const Alignment& alignment, std::size_t most) {
  const auto count =
      static_cast<std::size_t>(std::clamp<std::uint64_t>(alignment.ticks(), 1, std::max<std::uint64_t>(1, most)));
  std::vector<ComparedBin> bins(count);
  for (std::size_t i = 0; i < count; ++i) {
    bins[i].first = alignment.first + alignment.ticks() * i / count;
    for (ComparedBin::Values* low : {&bins[i].least_a, &bins[i].least_b})
      low->fill(std::numeric_limits<double>::infinity());
    for (ComparedBin::Values* high : {&bins[i].most_a, &bins[i].most_b})
      high->fill(-std::numeric_limits<double>::infinity());
  }
  return bins;
}

Alignment narrowed(Alignment alignment, const CompareRecordingsOptions& options) {
  if (!alignment.aligned()) return alignment;
  const std::uint64_t first = std::max(alignment.first, options.from), last = std::min(alignment.last, options.to);
  if (last < first) {
    alignment.why_not = "no tick of both is in the range that was asked for";
    return alignment;
  }
  alignment.first = first;
  alignment.last = last;
  return alignment;
}

RecordingsCompared not_aligned(const Alignment& alignment) {
  RecordingsCompared out;
  out.alignment = alignment;
  out.why = alignment.why_not;
  return out;
}

Result<OpenedPair> open_pair(const std::filesystem::path& a, const std::filesystem::path& b,
                             const CompareRecordingsOptions& options) {
  Result<Recording> first = Recording::open(a), second = Recording::open(b);
  if (!first) return tl::unexpected(first.error());
  if (!second) return tl::unexpected(second.error());
  Result<Alignment> found = align(*first, *second, options.by, options.note);
  if (!found) return tl::unexpected(found.error());
  return OpenedPair{std::move(*first), std::move(*second), narrowed(std::move(*found), options)};
}

PairCounter::PairCounter(const Alignment& alignment, const CompareRecordingsOptions& options)
    : tolerance_(options.tolerance), spectrum_a_(alignment.rate_hz), spectrum_b_(alignment.rate_hz) {
  out_.alignment = alignment;
  out_.full = true;
  out_.quantities = no_differences(options.tolerance);
  out_.bins = empty_bins(alignment, options.bins);
}

void PairCounter::add(const ComparedTick& a, const ComparedTick& b) {
  const bool together = !(glm::distance(a.finger, b.finger) > tolerance_.finger_m);
  add_curves(a, b, together);
  add_spectra(a, b);
  if (!together) {
    ++out_.apart;
    return;
  }
  ++out_.compared;
  const bool both_touch = touches(a.status) && touches(b.status);
  if (touches(a.status) != touches(b.status) || is_converged(a.status) != is_converged(b.status)) ++out_.other_contacts;
  for (std::size_t q = 0; q < kComparedQuantities.size(); ++q) {
    const ComparedQuantity& of = kComparedQuantities[q];
    if (q == kContactQuantity && !both_touch) continue;  // what is tracked without touching nobody feels
    double squares = 0.0;
    for (std::size_t i = of.first; i < of.first + of.count; ++i)
      squares += (a.values[i] - b.values[i]) * (a.values[i] - b.values[i]);
    QuantityDifference& d = out_.quantities[q];
    d.rms += squares;
    const double by = std::sqrt(squares);
    if (d.judged() && by > d.tolerance) ++d.over;
    if (!(by > d.at_most)) continue;
    d.at_most = d.at_least = by;
    d.worst_tick = a.tick;
  }
}

void PairCounter::add_spectra(const ComparedTick& a, const ComparedTick& b) {
  const bool follows = last_ && a.tick == *last_ + 1;
  last_ = a.tick;
  spectrum_a_.add({a.values[0], a.values[1], a.values[2]}, a.values[3], follows);
  spectrum_b_.add({b.values[0], b.values[1], b.values[2]}, b.values[3], follows);
}

void PairCounter::add_curves(const ComparedTick& a, const ComparedTick& b, bool together) {
  ComparedBin& bin = out_.bins[bin_of(out_.alignment, a.tick, out_.bins.size())];
  ++bin.ticks;
  for (std::size_t i = 0; i < kComparedChannelCount; ++i) {
    const double va = a.values[i], vb = b.values[i];
    bin.least_a[i] = std::min(bin.least_a[i], va);
    bin.most_a[i] = std::max(bin.most_a[i], va);
    bin.least_b[i] = std::min(bin.least_b[i], vb);
    bin.most_b[i] = std::max(bin.most_b[i], vb);
    if (together) bin.at_least[i] = bin.at_most[i] = std::max(bin.at_most[i], std::abs(va - vb));
  }
}

void PairCounter::join(const PairCounter& other) {
  const RecordingsCompared& o = other.out_;
  out_.compared += o.compared;
  out_.apart += o.apart;
  out_.in_one_only += o.in_one_only;
  spectrum_a_.join(other.spectrum_a_);
  spectrum_b_.join(other.spectrum_b_);
  out_.other_contacts += o.other_contacts;
  for (std::size_t q = 0; q < out_.quantities.size(); ++q) {
    QuantityDifference& d = out_.quantities[q];
    const QuantityDifference& from = o.quantities[q];
    d.rms += from.rms;
    d.over += from.over;
    if (!(from.at_most > d.at_most)) continue;
    d.at_least = d.at_most = from.at_most;
    d.worst_tick = from.worst_tick;
  }
  for (std::size_t i = 0; i < out_.bins.size(); ++i) {
    ComparedBin& bin = out_.bins[i];
    const ComparedBin& from = o.bins[i];
    bin.ticks += from.ticks;
    for (std::size_t c = 0; c < kComparedChannelCount; ++c) {
      bin.least_a[c] = std::min(bin.least_a[c], from.least_a[c]);
      bin.most_a[c] = std::max(bin.most_a[c], from.most_a[c]);
      bin.least_b[c] = std::min(bin.least_b[c], from.least_b[c]);
      bin.most_b[c] = std::max(bin.most_b[c], from.most_b[c]);
      bin.at_least[c] = bin.at_most[c] = std::max(bin.at_most[c], from.at_most[c]);
    }
  }
}

CompareOutcome PairCounter::outcome() const {
  if (out_.compared <= out_.apart) return CompareOutcome::not_aligned;
  const auto is_over = [](const QuantityDifference& d) { return d.over > 0; };
  const bool over = std::any_of(out_.quantities.begin(), out_.quantities.end(), is_over);
  return over || out_.other_contacts > 0 ? CompareOutcome::different : CompareOutcome::same;
}

RecordingsCompared PairCounter::done() {
  const double count = static_cast<double>(std::max<std::uint64_t>(1, out_.compared));
  for (QuantityDifference& d : out_.quantities) d.rms = std::sqrt(d.rms / count);
  out_.spectrum_a = spectrum_a_.done();
  out_.spectrum_b = spectrum_b_.done();
  out_.outcome = outcome();
  if (out_.outcome == CompareOutcome::not_aligned)
    out_.why = out_.compared + out_.apart == 0
                   ? "no tick is in both"
                   : "the fingers are further apart than the tolerance in " + std::to_string(out_.apart) + " of " +
                         std::to_string(out_.compared + out_.apart) + " ticks: these are other motions";
  return std::move(out_);
}

}  // namespace tangent
