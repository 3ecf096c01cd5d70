#include "workbench/evidence/check_preset.h"

#include "core/base/text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tangent {
namespace {

std::string number_text(double value) {
  std::string text;
  append_double(text, value);
  return text;
}

bool agrees(const EvidenceNumber& number, double measured, double now, bool same_build) {
  if (number.compared == Compared::never || measured == now) return true;
  if (number.compared == Compared::exactly || same_build) return false;
  const double allowed = kRoundingFloor + kRoundingShare * std::max(std::abs(measured), std::abs(now));
  return std::abs(measured - now) <= allowed;
}

void compare_values(const Preset& measured, const Preset& now, std::vector<CheckDifference>& out) {
  for (const PresetKey& key : preset_keys()) {
    const double before = key.get(measured), after = key.get(now);
    if (in_evidence(key) && before != after)
      out.push_back({key.full_name(), key.value_text(before), key.value_text(after)});
  }
}

void compare_texts(const std::string& what, const std::string& measured, const std::string& now,
                   std::vector<CheckDifference>& out) {
  if (measured != now) out.push_back({what, measured, now});
}

PresetCheck impossible(std::string why) {
  PresetCheck check;
  check.why = std::move(why);
  return check;
}

PresetCheck compare_with(const PresetFile& file, const EvidenceRun& run) {
  const PresetEvidence& evidence = *file.about.measured;
  PresetCheck check;
  check.now = run.numbers;
  check.same_build = evidence.build == evidence_build();
  std::vector<CheckDifference>& found = check.differences;
  if (!evidence.edited_digest.empty())
    found.push_back({"about.measured.digest", evidence.edited_digest, "of other numbers"});
  compare_values(evidence.values, file.preset, found);
  compare_texts("mesh", evidence.mesh.hash, run.mesh_hash, found);
  if (!file.about.mesh_hash.empty()) compare_texts("about.mesh_hash", evidence.mesh.hash, file.about.mesh_hash, found);
  // Another build may round a pose otherwise where it makes the motion; its numbers are compared all the same.
  const bool made = evidence.motion.file.empty();
  if (!made || check.same_build) compare_texts("motion", evidence.motion.digest, run.motion_digest, found);
  for (const EvidenceNumber& number : evidence_numbers()) {
    const double measured = evidence.numbers.*number.field, now = run.numbers.*number.field;
    if (!agrees(number, measured, now, check.same_build))
      found.push_back({std::string(number.key), number_text(measured), number_text(now)});
  }
  check.outcome = found.empty() ? CheckOutcome::holds : CheckOutcome::changed;
  return check;
}

std::string holds_text(const PresetCheck& check) {
  char text[200];
  const EvidenceNumbers& n = check.now;
  std::snprintf(
      text, sizeof text, "holds: %.0f ticks, %.0f unconverged, mean %.4g planes, p99 %.0f, error at most %.3g um%s",
      n.ticks, n.unconverged_ticks, n.mean_planes, n.p99_planes,
      n.compared_ticks > 0.0 ? n.error_worst_um : n.residual_worst_um, check.same_build ? ", to the last bit" : "");
  return text;
}

}  // namespace

const char* to_string(CheckOutcome outcome) {
  switch (outcome) {
    case CheckOutcome::holds:
      return "holds";
    case CheckOutcome::changed:
      return "changed";
    default:
      return "can't be checked";
  }
}

std::optional<PresetCheck> check_preset_evidence(const PresetFile& file, const EvidenceOptions& options) {
  if (!file.about.measured)
    return impossible(
        "it names nothing that could be measured again; attach evidence with \"workbench check --attach\", or save it "
        "in the window with a selection");
  const auto run = run_evidence(*file.about.measured, file.preset, options);
  if (!run) return impossible(run.error().message());
  if (!*run) return std::nullopt;
  return compare_with(file, **run);
}

std::optional<PresetCheck> check_preset_file(const std::filesystem::path& path, EvidenceOptions options) {
  const Result<PresetFile> file = read_preset(path);
  if (!file) return impossible(file.error().message());
  options.folder = path.parent_path();
  return check_preset_evidence(*file, options);
}

std::string check_text(const PresetCheck& check) {
  if (check.outcome == CheckOutcome::holds) return holds_text(check);
  std::string text = to_string(check.outcome);
  if (check.outcome == CheckOutcome::impossible) return text + ": " + check.why;
  for (const CheckDifference& d : check.differences)
    text += "\n  " + d.what + ": " + d.measured + " when measured, " + d.now + " now";
  return text;
}

}  // namespace tangent
