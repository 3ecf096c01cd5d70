// A ghost stays visible where it matters most: where what was recorded failed and the ghost did not.
#include "tests/workbench/gui/headless_app.h"
#include "workbench/gui/plots/plot_view.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

using namespace tangent;
using tangent::test::HeadlessApp;

namespace {

struct Inked {
  std::size_t first = 0, last = 0;  ///< places in the draw list
  float top = 1e9f, bottom = -1e9f;
  bool any = false;
};

Inked inked(const ImDrawList& list, ImU32 ink, float from_x, float to_x, float from_y) {
  Inked out;
  for (int i = 0; i < list.VtxBuffer.Size; ++i) {
    const ImDrawVert& v = list.VtxBuffer[i];
    if ((v.col & ~IM_COL32_A_MASK) != (ink & ~IM_COL32_A_MASK) || (v.col & IM_COL32_A_MASK) == 0) continue;
    if (v.pos.x < from_x || v.pos.x > to_x || v.pos.y < from_y) continue;
    if (!out.any) out.first = static_cast<std::size_t>(i);
    out.last = static_cast<std::size_t>(i);
    out.top = std::min(out.top, v.pos.y);
    out.bottom = std::max(out.bottom, v.pos.y);
    out.any = true;
  }
  return out;
}

}  // namespace

TEST_CASE(
    "where the recorded ticks failed and the ghost's did not, the ghost is over the curve and clear of the marks") {
  HeadlessApp app;
  ChannelStore store(2, 4000), ghost(1, 4000);
  for (std::uint64_t tick = 0; tick < 4000; ++tick) {
    const bool failed = tick >= 1500 && tick < 2500;
    const std::array<float, 2> recorded{failed ? 120.0f : 3.0f, failed ? 3.0f : std::nanf("")};
    store.push(tick, recorded);
    ghost.push(tick, std::array<float, 1>{3.0f});
  }
  PlotSpec spec;
  spec.id = "one";
  spec.counts = true;
  spec.series.push_back({"iterations", 0, &Palette::iterations, true, true, std::size_t{0}});
  const PlotSeries series = spec.series.front();
  PlotView plot(spec);
  const ImU32 orange = IM_COL32(240, 160, 10, 255);
  const std::array<ImU32, 4> inks{orange, orange, orange, orange};
  PlotLink link;
  link.ghost = &ghost;
  link.marks = {std::size_t{1}, inks, {}, {}};
  TimeAxis axis;
  axis.update(0, 4000, 4000.0);
  axis.show(0.0, 4000.0);

  ImFont* font = ImGui::GetIO().Fonts->Fonts[0];
  const ThemeFonts fonts{font, font, font, font, font};
  ItemMap items;
  Typing typing;
  Resting resting;
  std::map<std::string, bool> sections;
  const UiContext ui{items, typing, resting, theme_colours(Theme::dark), palette(Theme::dark), fonts, sections, 1.0f};
  ImGui::NewFrame();
  ImGui::SetNextWindowPos({0.0f, 0.0f});
  ImGui::SetNextWindowSize({900.0f, 120.0f});
  ImGui::Begin("one plot", nullptr, ImGuiWindowFlags_NoDecoration);
  plot.draw(ui, store, axis, link, {0.0f, 0.0f}, {900.0f, 120.0f}, true);
  ImGui::End();
  ImGui::Render();
  const ItemRect area = *items.find("plots/one");
  const float width = area.max.x - area.min.x, from = area.min.x + 0.45f * width, to = area.min.x + 0.55f * width;
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const ImDrawList& list = *data.CmdLists[i];
    if (std::string_view(list._OwnerName) != "one plot") continue;
    const Inked seen = inked(list, ghost_ink(ui, series), from, to, area.min.y);
    const Inked recorded = inked(list, packed(palette(Theme::dark).iterations), from, to, area.min.y);
    const Inked events = inked(list, orange, from, to, area.min.y);
    REQUIRE(seen.any);
    REQUIRE(recorded.any);
    REQUIRE(events.any);
    CHECK(seen.first > recorded.last);
    CHECK(seen.bottom <= area.max.y);
    CHECK(events.top >= area.max.y);
    CHECK(recorded.top < area.min.y + 0.4f * (area.max.y - area.min.y));
  }
}
