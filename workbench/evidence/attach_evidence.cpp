#include "workbench/evidence/attach_evidence.h"

#include "core/io/file_name.h"
#include "workbench/evidence/made_mesh.h"

#include <chrono>
#include <cstdio>

namespace tangent {
namespace {

std::string today_utc() {
  const auto days = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
  const std::chrono::year_month_day date(days);
  char text[40];
  std::snprintf(text, sizeof text, "%04d-%02u-%02u", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                static_cast<unsigned>(date.day()));
  return text;
}

std::string mesh_name_of(const PresetEvidence& evidence) {
  if (evidence.mesh.source.empty()) return file_name_text(file_named(evidence.motion.file).filename());
  if (const auto made = made_from(evidence.mesh.source)) return made->object;
  return file_name_text(file_named(evidence.mesh.source).filename());
}

}  // namespace

Result<std::optional<PresetFile>> attach_evidence(PresetFile file, PresetEvidence asked,
                                                  const EvidenceOptions& options) {
  asked.values = file.preset;
  asked.values.controller = {};  // no tick reads it
  auto measured = measure_evidence(std::move(asked), options);
  if (!measured) return tl::unexpected(measured.error());
  if (!*measured) return std::optional<PresetFile>();
  PresetAbout& about = file.about;
  about.date = today_utc();
  about.program_version = (*measured)->program_version;
  if (about.mesh_hash != (*measured)->mesh.hash) {
    about.mesh_name = mesh_name_of(**measured);
    about.mesh_hash = (*measured)->mesh.hash;
    about.metres_per_unit = about.longest_side_m = 0.0;  // they were another's
  }
  about.measured = std::move(**measured);
  return std::optional(std::move(file));
}

}  // namespace tangent
