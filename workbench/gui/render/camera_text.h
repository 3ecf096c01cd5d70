// A camera as one line of text, for copying a view through the clipboard.
#pragma once

#include "workbench/gui/render/camera.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace tangent {

/// "camera target_m 0 0 0 distance_m 0.3 yaw_deg -34.4 pitch_deg 25.8 up z": every digit.
std::string camera_text(const Camera& camera);
/// The camera `now` with the values of the text; empty when the text is not a camera.
std::optional<Camera> parse_camera(std::string_view text, Camera now);

/// Along an axis, or from the corner (the initial view).
enum class StandardView : std::uint8_t { front, back, left, right, top, bottom, corner };
/// Names for menu, commands and keys.
struct NamedView {
  StandardView view;
  const char* name;
  char key[2];  ///< a digit, as text
};
inline constexpr std::array<NamedView, 7> kStandardViews{{{StandardView::front, "front", "1"},
                                                          {StandardView::back, "back", "2"},
                                                          {StandardView::left, "left", "3"},
                                                          {StandardView::right, "right", "4"},
                                                          {StandardView::top, "top", "5"},
                                                          {StandardView::bottom, "bottom", "6"},
                                                          {StandardView::corner, "corner", "0"}}};
Camera standard_view(StandardView view, Camera camera);

}  // namespace tangent
