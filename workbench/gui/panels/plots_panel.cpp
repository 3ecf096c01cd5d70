// The live plots on a shared time axis: in columns where the panel is wide and low, stacked where it is high enough.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace tangent {

namespace {

constexpr std::size_t at(Channel c) { return static_cast<std::size_t>(c); }

/// Column and weight of each plot.
struct Cell {
  std::size_t plot;
  int column;
  float weight;  ///< of the column's height
};
constexpr std::array kThreeColumns{Cell{0, 0, 1.0f},  Cell{1, 1, 0.5f},  Cell{2, 1, 0.5f},
                                   Cell{3, 2, 0.43f}, Cell{5, 2, 0.28f}, Cell{4, 2, 0.29f}};
constexpr std::array kTwoColumns{Cell{0, 0, 0.4f},  Cell{1, 0, 0.3f},  Cell{5, 0, 0.3f},
                                 Cell{2, 1, 0.34f}, Cell{3, 1, 0.33f}, Cell{4, 1, 0.33f}};
constexpr std::array kOneColumn{Cell{0, 0, 0.25f}, Cell{1, 0, 0.15f}, Cell{2, 0, 0.15f},
                                Cell{3, 0, 0.15f}, Cell{4, 0, 0.15f}, Cell{5, 0, 0.15f}};

struct Arrangement {
  const std::array<Cell, 6>* cells;
  int columns;
};
Arrangement arrange(float width, float height) {
  // A stacked plot needs about 90 points for more than one labelled line.
  if (height > 520.0f) return {&kOneColumn, 1};
  if (height > 280.0f && width < 1500.0f) return {&kTwoColumns, 2};
  return {&kThreeColumns, 3};
}

}  // namespace

/// Marks of this frame.
static void collect_marks(const UiContext& ui, const TimeModel& time, PlotsPanel& state) {
  state.event_inks = {ui.colours.text_faint, bookmark_ink(ui, BookmarkKind::reseeded),
                      bookmark_ink(ui, BookmarkKind::unconverged), bookmark_ink(ui, BookmarkKind::device_fault)};
  state.changes.clear();
  for (const ParameterMark& mark : time.parameter_marks())
    state.changes.push_back({mark.tick, mark.tick, mark.text, ui.colours.accent});
  state.flags.clear();
  for (const Bookmark& mark : time.bookmarks().all()) {
    const bool mine = mark.kind == BookmarkKind::user;
    const std::string note = mark.note.empty() ? std::string() : ": " + mark.note;
    state.flags.push_back({mark.tick, mark.last_tick, to_string(mark.kind) + note, bookmark_ink(ui, mark.kind)});
    if (!mine && mark.ticks > 1) state.flags.back().text += printed(" and %u more ticks", mark.ticks - 1);
  }
  state.link.marks = {at(Channel::event), state.event_inks, state.changes, state.flags};
}

std::pair<std::uint64_t, std::uint64_t> ticks_in_view(const TimeModel& time) {
  const ChannelStore& store = time.store();
  const auto tick = [&](double t) {
    return std::clamp(static_cast<std::uint64_t>(std::max(0.0, std::ceil(t))), store.first_tick(), store.end_tick());
  };
  return {tick(time.axis().from()), tick(time.axis().to())};
}

/// What the user did to the plots' channels in this frame. The first problem is a message.
static void change_lists(AppModel& model, PlotLink& link) {
  PlotLists& lists = model.window().plots();
  Status done;
  if (link.removed) done = lists.remove(link.removed->plot, link.removed->channels);
  if (link.dropped) {
    std::istringstream keys(link.dropped->channels);
    for (std::string key; done && std::getline(keys, key);) done = lists.add(link.dropped->plot, key);
  }
  if (!done) model.messages().say(Severity::warning, done.error().message());
  link.removed.reset();
  link.dropped.reset();
}

static void draw_time_plots(const UiContext& ui, AppModel& model, PlotsPanel& state, const Rect& rect) {
  PlotLink& link = state.link;
  const Arrangement arrangement = arrange(rect.w / ui.scale, rect.h / ui.scale);
  const float gap = ui.px(4);
  const float column_width = (rect.w - gap) / static_cast<float>(arrangement.columns);
  std::array<float, 3> y{rect.y + ui.px(2), rect.y + ui.px(2), rect.y + ui.px(2)};
  const float labels = ui.px(13);  // the lowest plot of a column has the time labels
  const float height = rect.h - ui.px(4) - labels;
  for (std::size_t i = 0; i < arrangement.cells->size(); ++i) {
    const Cell& cell = (*arrangement.cells)[i];
    const bool last = i + 1 == arrangement.cells->size() || (*arrangement.cells)[i + 1].column != cell.column;
    auto& top = y[static_cast<std::size_t>(cell.column)];
    const float h = std::floor(cell.weight * height) + (last ? labels : 0.0f);
    // One draw list per plot, because of its 16-bit indices.
    ImGui::SetCursorScreenPos({rect.x + static_cast<float>(cell.column) * column_width, top});
    ImGui::BeginChild(state.plots[cell.plot].spec().id.c_str(), {column_width, h}, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav);
    PlotView& plot = state.plots[cell.plot];
    const bool of_error = !plot.spec().series.empty() && plot.spec().series.front().key == "error";
    const double reference = of_error ? model.presets().current().solver.tolerance_m : std::nan("");
    plot.draw(ui, model.time().store(), model.time().axis(), link, ImGui::GetWindowPos(), {column_width, h}, last,
              reference);
    ImGui::EndChild();
    top += h;
  }
}

void draw_plots_panel(const UiContext& ui, AppModel& model, PlotsPanel& state, const Rect& rect) {
  if (rect.w < ui.px(60) || rect.h < ui.px(30)) return;
  ImGui::SetNextWindowPos({rect.x, rect.y});
  ImGui::SetNextWindowSize({rect.w, rect.h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoScrollWithMouse |
                                     ImGuiWindowFlags_NoBackground;
  ImGui::Begin("##plots", nullptr, flags);
  ImGui::PopStyleVar();
  PlotLink& link = state.link;
  link.tick_period_s = model.time().tick_period_s();
  link.hover = link.hover_next;
  link.hover_next.reset();
  link.clicked.reset();
  link.cursor.reset();
  if (model.time().paused() && model.time().tick().record() != nullptr)
    link.cursor = model.time().tick().record()->tick.tick;

  const std::shared_ptr<const ChannelStore> ghost = model.time().ghost_channels();
  link.ghost = ghost.get();
  collect_marks(ui, model.time(), state);
  follow_lists(state, model.window().plots());
  update_derived(state, model.time());

  const float bar = ui.px(24);
  draw_plots_toolbar(ui, model, state, {rect.x, rect.y, rect.w, bar}, rect);
  Rect rest{rect.x, rect.y + bar, rect.w, rect.h - bar};
  if (state.channels.open && rect.w > ui.px(500)) {
    const float list = ui.px(230);
    draw_channels_list(ui, model, state, {rest.x, rest.y, list, rest.h});
    rest.x += list;
    rest.w -= list;
  }
  if (state.values && rect.w > ui.px(700)) {
    const int extra = (state.link.ghost != nullptr) + state.link.a.has_value() + state.link.b.has_value() +
                      (state.link.a && state.link.b);
    const float table = std::min(ui.px(166.0f + 62.0f * static_cast<float>(5 + extra)), 0.5f * rect.w);
    rest.w -= table;
    draw_values_table(ui, model.time(), state, {rest.right(), rest.y, table, rest.h});
  }
  if (state.mode == PlotsMode::time)
    draw_time_plots(ui, model, state, rest);
  else
    draw_other_plot(ui, model, state, rest);
  if (state.legend) draw_plots_legend(ui, state, rest);
  ImGui::End();
  change_lists(model, link);
  model.time().set_selection(link.a && link.b
                                 ? std::optional(TickRange{std::min(*link.a, *link.b), std::max(*link.a, *link.b)})
                                 : std::nullopt);
  if (link.clicked && !model.time().store().empty()) model.time().select_tick(*link.clicked);
}

}  // namespace tangent
