// A strip with a line of text and a few buttons over the middle of the window, for what needs an answer and may wait.
#pragma once

#include "workbench/gui/layout/layout.h"
#include "workbench/gui/widgets/ui_context.h"

#include <optional>
#include <span>
#include <string>

namespace tangent {

struct StripButton {
  const char* path;  ///< in the item map
  const char* text;
  const char* tip;
  bool fault = false;  ///< red: something went wrong, and this is about it
};

enum class StripPlace { upper_edge, lower_edge };

/// The index of the button that was pressed. The text wraps where the room is narrow; not drawn where there is none.
std::optional<std::size_t> draw_strip(const UiContext& ui, const char* name, const Rect& over, StripPlace place,
                                      const std::string& text, std::span<const StripButton> buttons);

}  // namespace tangent
