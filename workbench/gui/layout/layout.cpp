#include "workbench/gui/layout/layout.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {
constexpr float kMenu = 32.0f, kTransport = 34.0f, kStatus = 22.0f, kSplitter = 5.0f;  // points
constexpr float kLeastViewWidth = 280.0f, kLeastViewHeight = 160.0f;
constexpr float kNarrowView = 200.0f;  // beside the only column for which there is room
constexpr float kLeastColumn = 250.0f, kMostColumn = 620.0f;
constexpr float kLeastPlots = 90.0f, kMostPlots = 1400.0f;
constexpr float kRightShare = 0.19f, kLeastRight = 328.0f, kMostRight = 470.0f;
constexpr float kPlotShare = 0.325f, kLeastByShare = 200.0f, kMostByShare = 560.0f;

struct Columns {
  float left = 0.0f, right = 0.0f;  ///< with their splitters
};

/// One column where there is no room for two, or none.
float only_column(float wanted, float width, float scale) {
  const float least = kLeastColumn * scale;
  const float beside = std::min(wanted, width - kLeastViewWidth * scale);
  if (beside >= least) return std::floor(beside);
  return width - kNarrowView * scale >= least ? std::floor(least) : 0.0f;
}

Columns columns(const LayoutSizes& sizes, float width, float scale, float gap) {
  const auto px = [scale](float points) { return std::round(points * scale); };
  const float by_share = std::clamp(kRightShare * width / scale, kLeastRight, kMostRight);
  Columns out{sizes.show_left ? px(sizes.left) + gap : 0.0f,
              sizes.show_right ? px(sizes.right > 0.0f ? sizes.right : by_share) + gap : 0.0f};
  const float both = out.left + out.right, room = width - px(kLeastViewWidth);
  if (both <= room) return out;
  const Columns wanted = out;
  const float keep = std::max(0.0f, room / both);
  out = {std::floor(out.left * keep), std::floor(out.right * keep)};
  const float least = px(kLeastColumn) + gap;
  if (std::min(out.left > 0.0f ? out.left : least, out.right > 0.0f ? out.right : least) >= least) return out;
  const bool right = wanted.left == 0.0f || (sizes.prefer_right && wanted.right > 0.0f);
  const float only = only_column(right ? wanted.right : wanted.left, width, scale);
  return right ? Columns{0.0f, only} : Columns{only, 0.0f};
}

}  // namespace

Layout compute_layout(const LayoutSizes& sizes, float width, float height, float scale) {
  Layout out;
  const auto px = [scale](float points) { return std::round(points * scale); };
  const float menu = px(kMenu), transport = px(kTransport), status = px(kStatus), gap = px(kSplitter);
  out.menu = {0, 0, width, menu};
  out.status = {0, height - status, width, status};
  out.transport = {0, height - status - transport, width, transport};
  const float middle = std::max(0.0f, height - menu - status - transport);

  const float by_share = std::clamp(kPlotShare * middle / scale, kLeastByShare, kMostByShare);
  float plots = sizes.show_plots ? px(sizes.plots > 0.0f ? sizes.plots : by_share) + gap : 0.0f;
  plots = std::clamp(plots, 0.0f, std::max(0.0f, middle - px(kLeastViewHeight)));
  if (plots < px(kLeastPlots)) plots = 0.0f;
  const auto [left, right] = columns(sizes, width, scale, gap);
  const float above = middle - plots;
  const auto minus_gap = [gap](float v) { return std::max(0.0f, v - gap); };
  out.left = {0, menu, minus_gap(left), above};
  out.left_splitter = {out.left.w, menu, std::min(gap, left), above};
  out.right = {width - minus_gap(right), menu, minus_gap(right), above};
  out.right_splitter = {width - right, menu, std::min(gap, right), above};
  out.view = {left, menu, std::max(0.0f, width - left - right), above};
  out.plot_splitter = {0, menu + above, width, std::min(gap, plots)};
  out.plots = {0, menu + above + std::min(gap, plots), width, minus_gap(plots)};
  return out;
}

LayoutSizes within_limits(LayoutSizes sizes) {
  sizes.left = std::clamp(sizes.left, kLeastColumn, kMostColumn);
  if (sizes.right > 0.0f) sizes.right = std::clamp(sizes.right, kLeastColumn, kMostColumn);
  if (sizes.plots > 0.0f) sizes.plots = std::clamp(sizes.plots, kLeastPlots, kMostPlots);
  return sizes;
}

LayoutSizes drag_left(LayoutSizes sizes, float dx, float scale) {
  sizes.left = std::clamp(sizes.left + dx / scale, kLeastColumn, kMostColumn);
  return sizes;
}
LayoutSizes drag_right(LayoutSizes sizes, float dx, float shown, float scale) {
  sizes.right = std::clamp((shown - dx) / scale, kLeastColumn, kMostColumn);
  return sizes;
}
LayoutSizes drag_plots(LayoutSizes sizes, float dy, float shown, float scale) {
  sizes.plots = std::clamp((shown - dy) / scale, kLeastPlots, kMostPlots);
  return sizes;
}

}  // namespace tangent
