#include "workbench/gui/layout/layout.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <tuple>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("the parts fill the window without overlapping, from 1280 x 720 to 4K at any scale") {
  for (const auto& [w, h, scale] : {std::tuple{1280.0f, 720.0f, 1.0f},
                                    {3840.0f, 2160.0f, 1.0f},
                                    {3840.0f, 2160.0f, 2.0f},
                                    {1920.0f, 1080.0f, 1.5f},
                                    {1280.0f, 720.0f, 2.0f}}) {
    const Layout l = compute_layout({}, w, h, scale);
    CAPTURE(w);
    CAPTURE(scale);
    CHECK(l.menu.bottom() == l.view.y);
    CHECK(l.left_splitter.right() == l.view.x);
    CHECK(l.view.right() == l.right_splitter.x);
    CHECK(l.right.right() == w);
    CHECK(l.view.bottom() == l.plot_splitter.y);
    CHECK(l.plots.bottom() == l.transport.y);
    CHECK(l.status.bottom() == h);
    CHECK(l.view.w >= 279.0f * scale);
    CHECK(l.view.h >= 159.0f * scale);
  }
}

TEST_CASE("a window too small for everything has no negative sizes") {
  for (float w : {1.0f, 100.0f, 400.0f}) {
    for (float h : {1.0f, 80.0f, 300.0f}) {
      const Layout l = compute_layout({}, w, h, 2.0f);
      for (const Rect& r : {l.menu, l.left, l.view, l.right, l.plots, l.transport, l.status}) {
        REQUIRE(r.w >= 0.0f);
        REQUIRE(r.h >= 0.0f);
      }
    }
  }
}

TEST_CASE("hidden parts give their room to the 3D view") {
  LayoutSizes sizes;
  sizes.show_left = sizes.show_right = sizes.show_plots = false;
  const Layout l = compute_layout(sizes, 1280.0f, 720.0f, 1.0f);
  CHECK(l.view.x == 0.0f);
  CHECK(l.view.w == 1280.0f);
  CHECK(l.view.bottom() == l.transport.y);
}

TEST_CASE("splitters follow the pointer and stop at their ends") {
  LayoutSizes sizes;
  CHECK(drag_left(sizes, 20.0f, 2.0f).left == sizes.left + 10.0f);
  CHECK(drag_right(sizes, 20.0f, 400.0f, 1.0f).right == 380.0f);
  CHECK(drag_right(sizes, 20.0f, 800.0f, 2.0f).right == 390.0f);
  CHECK(drag_plots(sizes, -30.0f, 200.0f, 1.0f).plots == 230.0f);
  CHECK(drag_plots(sizes, -30.0f, 400.0f, 2.0f).plots == 215.0f);
  CHECK(drag_left(sizes, -1e6f, 1.0f).left > 100.0f);
  CHECK(drag_left(sizes, 1e6f, 1.0f).left < 1000.0f);
}

TEST_CASE("plots and the right column, where they were not dragged, take more room in a larger window") {
  const Layout small = compute_layout({}, 1280.0f, 720.0f, 1.0f), large = compute_layout({}, 2560.0f, 1440.0f, 1.0f);
  CHECK(small.plots.h >= 180.0f);
  CHECK(large.plots.h > 1.5f * small.plots.h);
  CHECK(large.plots.h < large.view.h);
  CHECK(large.right.w > 1.3f * small.right.w);
  CHECK(compute_layout({}, 2560.0f, 1440.0f, 2.0f).right.w == approx(2.0f * small.right.w));
  LayoutSizes dragged;
  dragged.right = 300.0f;
  CHECK(compute_layout(dragged, 2560.0f, 1440.0f, 1.0f).right.w == approx(300.0f));
}
