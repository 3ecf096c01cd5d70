// Measures again what a preset says was measured with it, and says whether it holds.
#pragma once

#include "core/io/preset_file.h"
#include "workbench/evidence/run_evidence.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tangent {

enum class CheckOutcome : std::uint8_t { holds, changed, impossible };
/// "holds", "changed", "can't be checked".
const char* to_string(CheckOutcome outcome);

struct CheckDifference {
  std::string what;           ///< "solver.gain_overall", "mean_planes", "mesh"
  std::string measured, now;  ///< as text
};

struct PresetCheck {
  CheckOutcome outcome = CheckOutcome::impossible;
  std::string why;  ///< impossible: the reason and what to do
  std::vector<CheckDifference> differences;
  bool same_build = false;  ///< all numbers were compared to the last bit
  EvidenceNumbers now;      ///< unless impossible
};

/// Another build computes the same counts; its errors, forces and places may differ by this share and, near zero, by
/// this much in the number's own unit (um, N, mm): other versions of the C library round sine and cosine otherwise.
inline constexpr double kRoundingShare = 1e-6, kRoundingFloor = 1e-6;

/// `options.folder`: the folder of the file. Empty: `keep_going` said no.
std::optional<PresetCheck> check_preset_evidence(const PresetFile& file, const EvidenceOptions& options);

/// Reads the file first; one that can't be read can't be checked.
std::optional<PresetCheck> check_preset_file(const std::filesystem::path& path, EvidenceOptions options);

/// What it holds for, what changed, or why it can't be checked: lines without the last newline.
std::string check_text(const PresetCheck& check);

}  // namespace tangent
