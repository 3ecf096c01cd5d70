// A camera as one line of text, for the clipboard: what one person sees, another can paste.
#pragma once

#include "workbench/gui/render/camera.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace tangent {

/// "camera target_m 0 0 0 distance_m 0.3 yaw_deg -34.4 pitch_deg 25.8 up z": every digit.
std::string camera_text(const Camera& camera);
/// The camera `now` with what the text says; none when it is no camera.
std::optional<Camera> parse_camera(std::string_view text, Camera now);

/// Straight at an axis, or from the corner all of them start from.
enum class StandardView : std::uint8_t { front, back, left, right, top, bottom, corner };
/// What menu, commands and keys call them.
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
