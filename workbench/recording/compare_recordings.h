// Two recordings side by side, or one under two presets: what goes together is compared tick by tick, or first, in a
// moment, by the minima and maxima that recordings keep of 256 ticks each.
#pragma once

#include "workbench/recording/alignment.h"
#include "workbench/recording/roughness_spectrum.h"

#include <functional>
#include <limits>
#include <string_view>
#include <vector>

namespace tangent {

/// What is compared as curves. SI; columns of a recording.
inline constexpr std::array<std::string_view, 10> kComparedChannels{
    "force_x_n",   "force_y_n",   "force_z_n",     "cld_m",   "contact_x_m",
    "contact_y_m", "contact_z_m", "penetration_m", "error_m", "iterations"};
inline constexpr std::size_t kComparedChannelCount = kComparedChannels.size();

/// Largest difference that counts as none. 0: identical.
struct CompareTolerance {
  double force_n = 0.01;
  double length_m = 1e-5;  ///< of display, contact and penetration
  double finger_m = 1e-3;  ///< ticks whose fingers are further apart are not compared
};

/// A part of the ticks that go together, as curves show it. `at_least` and `at_most` bound the largest difference of
/// two ticks that go together; they are one where every tick was compared.
struct ComparedBin {
  using Values = std::array<double, kComparedChannelCount>;
  std::uint64_t first = 0, ticks = 0;  ///< of A; no ticks: a gap
  Values least_a{}, most_a{}, least_b{}, most_b{}, at_least{}, at_most{};
};

/// Of a quantity, over the ticks that were compared; of vectors the length of the difference.
struct QuantityDifference {
  std::string_view name, unit;
  double tolerance = -1.0;               ///< below 0: it is shown, and not judged
  double rms = 0.0;                      ///< 0 where only bounds are known
  double at_least = 0.0, at_most = 0.0;  ///< of the largest
  std::uint64_t worst_tick = 0;          ///< of A: where it is, or in a bin of 256 ticks from there
  std::uint64_t over = 0;                ///< ticks (or bins) surely over the tolerance
  bool judged() const { return tolerance >= 0.0; }
};

enum class CompareOutcome : std::uint8_t {
  same,  ///< within the tolerances
  different,
  not_aligned,
  undecided,  ///< bounds leave it open
};
const char* to_string(CompareOutcome outcome);

struct RecordingsCompared {
  CompareOutcome outcome = CompareOutcome::not_aligned;
  std::string why;  ///< not aligned: why not
  Alignment alignment;
  bool full = false;                 ///< every tick, not bounds
  std::uint64_t compared = 0;        ///< ticks; of bounds those in bins
  std::uint64_t apart = 0;           ///< ticks whose fingers are too far apart
  std::uint64_t in_one_only = 0;     ///< ticks of the overlap that one of them lacks
  std::uint64_t other_contacts = 0;  ///< ticks that touch in one only, or are solved in one only
  std::vector<QuantityDifference> quantities;
  std::vector<ComparedBin> bins;
  RoughnessSpectrum spectrum_a, spectrum_b;  ///< of ticks that both have; no windows where only bounds are known
  bool cancelled = false;
  const QuantityDifference* worst() const;  ///< furthest over its tolerance; null: none is judged
};

struct CompareRecordingsOptions {
  AlignBy by = AlignBy::time;
  std::string note;  ///< of the bookmarks
  CompareTolerance tolerance;
  std::size_t bins = 1024;                                                 ///< at most
  std::uint64_t from = 0, to = std::numeric_limits<std::uint64_t>::max();  ///< ticks of A
  std::function<bool()> cancelled = [] { return false; };
};

/// By the recordings' own minima and maxima. Fails on damaged files.
Result<RecordingsCompared> compare_coarsely(const std::filesystem::path& a, const std::filesystem::path& b,
                                            const CompareRecordingsOptions& options = {});
/// Tick by tick, on two threads.
Result<RecordingsCompared> compare_fully(const std::filesystem::path& a, const std::filesystem::path& b,
                                         const CompareRecordingsOptions& options = {});

/// One recording, its motion solved under another preset (same motion assumed), against what was recorded.
/// `other`: the preset in place of a recorded one. `scene`: for one that was recorded without. `mesh`: in place of
/// every scene; null: as recorded.
struct OtherPreset {
  std::function<Preset(const Preset&)> other;
  std::shared_ptr<const ContactScene> scene = nullptr, mesh = nullptr;
};
Result<RecordingsCompared> compare_under(const std::filesystem::path& recording, const OtherPreset& how,
                                         const CompareRecordingsOptions& options = {});

}  // namespace tangent
