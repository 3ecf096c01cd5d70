// The window's layout: a fixed arrangement with three splitters. Pure arithmetic in ImGui's coordinates.
#pragma once

namespace tangent {

struct Rect {
  float x = 0.0f, y = 0.0f, w = 0.0f, h = 0.0f;
  float right() const { return x + w; }
  float bottom() const { return y + h; }
};

/// Sizes set by dragging the splitters, in points (times the scale: pixels).
struct LayoutSizes {
  float left = 312.0f;  ///< parameter column
  float right = 0.0f;   ///< iterations, mesh, devices; 0: not dragged yet, a fraction of the window
  float plots = 0.0f;   ///< height of the plots; 0: likewise
  bool show_left = true, show_right = true, show_plots = true;
  bool prefer_right = false;  ///< the column that stays where there is room for one
};

struct Layout {
  Rect menu, left, view, right, plots, transport, status;
  Rect left_splitter, right_splitter, plot_splitter;
};

/// Keeps the 3D view at least 280 x 160 points by shrinking the other parts. A part that would be too small for its
/// text is left out: first one column, then the other, and the plots. One column alone may leave the view 200 points.
Layout compute_layout(const LayoutSizes& sizes, float width, float height, float scale);

/// The same within the ranges that dragging keeps to; what was not dragged stays so.
LayoutSizes within_limits(LayoutSizes sizes);
/// Sizes after dragging a splitter by (dx, dy) pixels, clamped to useful ranges. `shown`: the current width of the
/// column, or height of the plots.
LayoutSizes drag_left(LayoutSizes sizes, float dx, float scale);
LayoutSizes drag_right(LayoutSizes sizes, float dx, float shown, float scale);
LayoutSizes drag_plots(LayoutSizes sizes, float dy, float shown, float scale);

}  // namespace tangent
