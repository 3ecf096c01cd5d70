// Report of a tuning: a text table, and the [about] table of the preset it writes.
#pragma once

#include "core/io/preset_file.h"
#include "core/lab/gains/gain_tuning.h"
#include "core/lab/gains/ground.h"
#include "core/mesh/contact_mesh.h"

#include <string>
#include <vector>

namespace tangent {

/// One method with the tuned gains on all poses.
struct MethodRun {
  Method method = Method::paper;
  RunScore score;
  double median_ns = 0.0;
  GroundCounts grounds;
};

struct TuneReport {
  const ContactMesh* mesh = nullptr;
  PresetFile preset;    ///< as it will be written
  std::string poses;    ///< description of the poses
  std::string command;  ///< that was run
  GainTuning tuning;
  MethodRun own;                  ///< the preset's method
  std::vector<MethodRun> others;  ///< the other two of paper, newton and robust
};

/// Fills preset.about from the rest.
void describe_measurement(TuneReport& report);

/// The ten best gains, the untuned ones, and the results of each method with them.
std::string tune_text(const TuneReport& report);

}  // namespace tangent
