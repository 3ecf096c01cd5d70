#include "workbench/gui/model/parameter_marks.h"

#include "workbench/gui/model/preset_editor.h"

namespace tangent {

std::string change_text(const Preset& before, const Preset& now) {
  std::string text;
  std::size_t more = 0;
  for (const PresetKey& key : preset_keys()) {
    const double was = key.get(before), is = key.get(now);
    if (was == is) continue;
    if (!text.empty()) {
      ++more;
      continue;
    }
    const std::string unit(display_unit(key).name);
    text = std::string(key.label) + " " + display_text(key, was) + " \u2192 " + display_text(key, is) +
           (unit.empty() ? "" : " " + unit);
  }
  if (more > 0) text += " and " + std::to_string(more) + " more";
  return text;
}

}  // namespace tangent
