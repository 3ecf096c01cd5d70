// What a command leaves to the frames that follow: a widget to press or to give a value, a time to wait for.
#pragma once

#include "workbench/gui/panels/panels.h"

#include <optional>
#include <string>

namespace tangent {

/// Presses the widget of this path (widgets/item_map.h), or gives it this value; its section or column is shown first.
void wish(AppModel& model, MenuBar& menu, const std::string& path, std::optional<std::string> value = std::nullopt);

}  // namespace tangent
