// The vertices that a plot adds to ImGui's draw list.
#include "tests/workbench/gui/headless_app.h"

#include "workbench/gui/plots/plot_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

using namespace tangent;
using tangent::test::HeadlessApp;

namespace {

constexpr std::uint64_t kOneHour = 3'600'000;
constexpr float kUsual = 0.25f, kSpike = 50.0f;

/// One plot of one channel in a window of its own, a frame a call.
class OnePlot {
 public:
  explicit OnePlot(ImVec2 size) : size_(size) {
    PlotSpec spec;
    spec.id = "one";
    spec.title = "One";
    spec.series.push_back({"curve", 0, &Palette::force_x});
    plot_.emplace(std::move(spec));
  }
  TimeAxis& axis() { return axis_; }
  PlotLink& link() { return link_; }
  const ItemRect& area() const { return *items_.find("plots/one"); }

  void frame(const ChannelStore& store) {
    ImFont* font = ImGui::GetIO().Fonts->Fonts[0];
    const ThemeFonts fonts{font, font, font, font, font};
    const UiContext ui{items_,    typing_, resting_, theme_colours(Theme::dark), palette(Theme::dark), fonts,
                       sections_, 1.0f,    0.0};
    ImGui::NewFrame();
    ImGui::SetNextWindowPos({0.0f, 0.0f});
    ImGui::SetNextWindowSize(size_);
    ImGui::Begin("one plot", nullptr, ImGuiWindowFlags_NoDecoration);
    plot_->draw(ui, store, axis_, link_, {0.0f, 0.0f}, size_, true);
    ImGui::End();
    ImGui::Render();
    // Where a value is, and the vertices of the curve in the plot's area: the legend above it has the same ink.
    const ImU32 ink = packed(palette(Theme::dark).force_x);
    const ImDrawData& data = *ImGui::GetDrawData();
    curve_.clear();
    below_.clear();
    for (int i = 0; i < data.CmdListsCount; ++i) {
      const ImDrawList& list = *data.CmdLists[i];
      if (std::string_view(list._OwnerName) != "one plot") continue;
      for (const ImDrawVert& v : list.VtxBuffer) {
        if ((v.col & ~IM_COL32_A_MASK) == (ink & ~IM_COL32_A_MASK) && v.pos.y >= area().min.y - 60.0f)
          curve_.push_back(v);
        if (v.pos.y > area().max.y) below_.push_back(v);
      }
    }
  }
  double y_of(float value) const {
    return static_cast<double>(area().max.y) -
           plot_->values().share(static_cast<double>(value), false) * static_cast<double>(area().max.y - area().min.y);
  }
  double x_of(std::uint64_t tick) const {
    return axis_.x_at(static_cast<double>(tick), static_cast<double>(area().min.x),
                      static_cast<double>(area().max.x - area().min.x));
  }
  bool bars() const {
    return axis_.span() / static_cast<double>(area().max.x - area().min.x) >= kTicksPerColumnForBars;
  }

  /// Where vertices of an ink lie below the plot, left to right.
  std::pair<float, float> below(ImU32 ink) const {
    std::pair<float, float> x{1e9f, -1e9f};
    for (const ImDrawVert& v : below_) {
      if ((v.col & ~IM_COL32_A_MASK) == (ink & ~IM_COL32_A_MASK))
        x = {std::min(x.first, v.pos.x), std::max(x.second, v.pos.x)};
    }
    return x;
  }
  int count_below(ImU32 ink, float from, float to) const {
    return static_cast<int>(std::count_if(below_.begin(), below_.end(), [&](const ImDrawVert& v) {
      return (v.col & ~IM_COL32_A_MASK) == (ink & ~IM_COL32_A_MASK) && v.pos.x >= from && v.pos.x <= to;
    }));
  }

  /// Left edges of the bars that reach up to the value.
  std::vector<float> bars_up_to(float value) const {
    std::vector<float> out;
    const auto y = static_cast<float>(y_of(value));
    for (const auto& corner : curve_) {
      if (corner.pos.y <= y + 0.01f && corner.pos.y >= area().min.y - 1.0f &&
          (out.empty() || corner.pos.x > out.back() + 1.5f || corner.pos.x < out.back()))
        out.push_back(corner.pos.x);
    }
    return out;
  }
  /// Points of the line there: four vertices each, about the point.
  int line_points_at(double x, double y) const {
    int count = 0;
    for (std::size_t i = 0; i + 4 <= curve_.size(); ++i) {
      double mx = 0.0, my = 0.0;
      for (std::size_t k = i; k < i + 4; ++k)
        mx += 0.25 * static_cast<double>(curve_[k].pos.x), my += 0.25 * static_cast<double>(curve_[k].pos.y);
      if (std::abs(mx - x) < 0.05 && std::abs(my - y) < 0.05) ++count;
    }
    return count;
  }

 private:
  ImVec2 size_;
  std::optional<PlotView> plot_;
  TimeAxis axis_;
  PlotLink link_;
  ItemMap items_;
  Typing typing_;
  Resting resting_;
  std::map<std::string, bool> sections_;
  std::vector<ImDrawVert> curve_, below_;
};

void require_spike_drawn(const OnePlot& plot, std::uint64_t spike, bool alone) {
  const double x = plot.x_of(spike);
  if (!plot.bars()) {
    REQUIRE(plot.line_points_at(x, plot.y_of(kSpike)) >= 1);
    return;
  }
  const std::vector<float> tall = plot.bars_up_to(kSpike);
  // A spike that is alone in its column (the first tick there is) is joined to the column after it.
  REQUIRE(tall.size() >= 1);
  REQUIRE(tall.size() <= (alone ? 2 : 1));
  REQUIRE(static_cast<double>(tall.front()) <= x);
  REQUIRE(static_cast<double>(tall.front()) > x - 2.0);
}

}  // namespace

TEST_CASE(
    "a spike of one sample among 3.6 million is drawn at every zoom and while it scrolls, in the place it belongs to") {
  HeadlessApp host;  // a font, a style
  struct Case {
    std::uint64_t first, spike;  ///< tick of the first sample; samples after it
  };
  // First and last sample, both sides of the pyramid's blocks, within one, and where the ring of 4,194,304 begins anew.
  constexpr std::array cases{Case{0, 0},
                             Case{0, kOneHour - 1},
                             Case{0, 7},
                             Case{0, 8},
                             Case{0, 262'143},
                             Case{0, 262'144},
                             Case{0, 2'222'222},
                             Case{1'000'003, 0},
                             Case{1'000'003, kOneHour - 1},
                             Case{1'000'003, 3'194'300},
                             Case{1'000'003, 3'194'301},
                             Case{1'000'003, 1'618'033}};
  std::vector<float> rows(kOneHour, kUsual);
  ChannelStore store(1, kOneHour);
  OnePlot narrow({291.0f, 120.0f}), wide({1291.0f, 200.0f});
  for (const Case& c : cases) {
    rows[c.spike] = kSpike;
    store.assign(c.first, rows);
    rows[c.spike] = kUsual;
    const std::uint64_t spike = c.first + c.spike;
    CAPTURE(spike);
    for (OnePlot* plot : {&narrow, &wide}) {
      TimeAxis& axis = plot->axis();
      axis.update(store.first_tick(), store.end_tick(), static_cast<double>(store.capacity()));
      for (double span = static_cast<double>(kOneHour); span > 10.0; span *= 0.57) {
        CAPTURE(span);
        axis.show(static_cast<double>(spike) - 0.37 * span, static_cast<double>(spike) + 0.63 * span);
        for (int scrolled = 0; scrolled < 3; ++scrolled) {
          plot->frame(store);
          require_spike_drawn(*plot, spike, c.spike == 0);
          axis.pan(0.017 * span);
        }
      }
      axis.show_all();
      plot->frame(store);
      require_spike_drawn(*plot, spike, c.spike == 0);
    }
  }
}

TEST_CASE("where there is no spike none is drawn") {
  HeadlessApp host;
  ChannelStore store(1, 1);
  std::vector<float> rows(200'000, kUsual);
  rows[100'000] = kSpike;
  store.assign(0, rows);
  OnePlot plot({600.0f, 200.0f});
  plot.axis().update(0, 200'000, 200'000.0);
  plot.axis().show(100'001.0, 200'000.0);
  plot.frame(store);
  CHECK(plot.bars_up_to(kSpike).empty());
  CHECK_FALSE(plot.bars_up_to(kUsual).empty());
}

TEST_CASE("a label of the time axis is whole or not there: a cursor's card never cuts one in two") {
  HeadlessApp host;
  ChannelStore store(1, 1);
  store.assign(0, std::vector<float>(20'000, kUsual));
  OnePlot plot({700.0f, 200.0f});
  plot.axis().update(0, 20'000, 20'000.0);
  plot.axis().show(0.0, 20'000.0);
  const ThemeColours& colours = theme_colours(Theme::dark);
  plot.frame(store);
  const int all = plot.count_below(colours.text_dim, 0.0f, 1e9f);
  REQUIRE(all > 0);
  int fewer = 0;
  for (std::uint64_t cursor = 0; cursor < 20'000; cursor += 130) {
    plot.link().cursor = cursor;
    plot.frame(store);
    const auto [left, right] = plot.below(colours.panel_header);
    REQUIRE(left < right);
    REQUIRE(plot.count_below(colours.text_dim, left, right) == 0);
    fewer += plot.count_below(colours.text_dim, 0.0f, 1e9f) < all;
  }
  CHECK(fewer > 0);
}
