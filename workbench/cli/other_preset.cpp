#include "workbench/cli/other_preset.h"

#include "workbench/recording/comparison_figures.h"

#include <cstdio>

namespace tangent {

Result<std::function<Preset(const Preset&)>> other_preset(const PresetOptions& options) {
  if (!options.file.empty() || options.condition >= 0) {
    Result<PresetFile> preset = load_preset(options);
    if (!preset) return tl::unexpected(preset.error());
    return [use = preset->preset](const Preset&) { return use; };
  }
  return [&options](const Preset& recorded) {
    Preset use = recorded;
    for (const PresetOverride& o : options.overrides) o.set(use, o.value);
    return use;
  };
}

Status write_comparison_figures(const RecordingsCompared& compared, const std::filesystem::path& recording,
                                const std::filesystem::path& folder) {
  const Result<Recording> opened = Recording::open(recording);
  if (!opened) return tl::unexpected(opened.error());
  const double rate_hz = opened->info().rate_hz(), period_s = rate_hz > 0.0 ? 1.0 / rate_hz : 1e-3;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return fail("can't be made: " + error.message(), folder.string(), "choose another folder");
  for (const Figure& figure : comparison_figures(compared, period_s)) {
    if (Status ok = write_figure(figure, folder); !ok) return ok;
    std::printf("%s: %s\n", (folder / (figure.name + ".svg")).c_str(), figure.title.c_str());
  }
  return {};
}

}  // namespace tangent
