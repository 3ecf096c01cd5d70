// Processor time of frames with many channels and an hour of history. A measurement, not a test: run it with --no-skip.
// Nothing passes or fails by time.
#include "tests/workbench/gui/headless_app.h"

#include "workbench/gui/plots/plot_view.h"
#include "workbench/gui/widgets/thread_time.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>

using namespace tangent;
using tangent::test::HeadlessApp;

namespace {

constexpr std::uint64_t kHour = 3'600'000;  // ticks at 1 kHz
constexpr std::uint64_t kTicksAFrame = 16;
constexpr std::size_t kPlots = 6;
constexpr std::size_t kMostChannels = 24, kEvents = kMostChannels;  // the last channel holds events
constexpr int kFrames = 300;
constexpr float kWidth = 1280.0f, kHeight = 720.0f;

void fill_row(std::uint64_t t, std::vector<float>& row) {
  for (std::size_t c = 0; c < kMostChannels; ++c) row[c] = static_cast<float>((t * (c + 7)) % 1009) * 1e-3f;
  row[kEvents] = t % 5003 == 0 ? 2.0f : std::nanf("");
}

/// An hour of it, one store for all measurements: they push on.
ChannelStore& hour() {
  static ChannelStore store = [] {
    ChannelStore made(kMostChannels + 1, kHour);
    std::vector<float> rows((kMostChannels + 1) * kHour), row(kMostChannels + 1);
    for (std::uint64_t t = 0; t < kHour; ++t) {
      fill_row(t, row);
      std::copy(row.begin(), row.end(), rows.begin() + static_cast<std::ptrdiff_t>(t * row.size()));
    }
    made.assign(0, rows);
    return made;
  }();
  return store;
}

struct Load {
  std::size_t channels = kMostChannels;
  bool statistics = false;  ///< minimum, maximum, mean and RMS of what is in view, as text beside the curves
  int columns = 3;          ///< of plots across the window
};

/// A window of plots and nothing else, with frames as the workbench makes them.
class PlotBench {
 public:
  explicit PlotBench(const Load& load) : load_(load) {
    for (std::size_t p = 0; p < kPlots; ++p) {
      PlotSpec spec;
      spec.id = "p" + std::to_string(p);
      spec.title = "Plot";
      for (std::size_t c = p; c < load.channels; c += kPlots)
        spec.series.push_back({"c" + std::to_string(c), c, &Palette::force_x});
      if (!spec.series.empty()) plots_.emplace_back(std::move(spec));
    }
    link_.marks.event_channel = kEvents;
    link_.marks.event_inks = inks_;
  }
  TimeAxis& axis() { return axis_; }

  /// Processor time of one frame, with the ticks that came since the last one, ms.
  double frame() {
    ChannelStore& store = hour();
    ImGui::NewFrame();
    const double begin = thread_cpu_ms();
    for (std::uint64_t i = 0; i < kTicksAFrame; ++i) {
      fill_row(store.end_tick(), row_);
      store.push(store.end_tick(), row_);
    }
    axis_.update(store.first_tick(), store.end_tick(), static_cast<double>(store.capacity()));
    draw(store);
    ImGui::Render();
    return thread_cpu_ms() - begin;
  }

 private:
  void draw(const ChannelStore& store) {
    ImFont* font = ImGui::GetIO().Fonts->Fonts[0];
    const ThemeFonts fonts{font, font, font, font, font};
    const UiContext ui{items_,    typing_, resting_, theme_colours(Theme::dark), palette(Theme::dark), fonts,
                       sections_, 1.0f,    0.0};
    const int rows = (static_cast<int>(kPlots) + load_.columns - 1) / load_.columns;
    const ImVec2 size{kWidth / static_cast<float>(load_.columns), kHeight / static_cast<float>(rows)};
    for (std::size_t p = 0; p < plots_.size(); ++p) {
      const int at = static_cast<int>(p);
      ImGui::SetNextWindowPos(
          {static_cast<float>(at % load_.columns) * size.x, static_cast<float>(at / load_.columns) * size.y});
      ImGui::SetNextWindowSize(size);
      ImGui::Begin(plots_[p].spec().id.c_str(), nullptr, ImGuiWindowFlags_NoDecoration);
      plots_[p].draw(ui, store, axis_, link_, ImGui::GetWindowPos(), size, true);
      ImGui::End();
    }
    if (!load_.statistics) return;
    const auto from = static_cast<std::uint64_t>(std::max(0.0, axis_.from())),
               to = static_cast<std::uint64_t>(axis_.to());
    ImGui::SetNextWindowPos({0.0f, 0.0f});
    ImGui::Begin("statistics", nullptr, ImGuiWindowFlags_NoDecoration);
    for (std::size_t c = 0; c < load_.channels; ++c) {
      const MinMax range = store.min_max(c, from, to);
      const SampleSums sums = store.sums(c, from, to);
      ImGui::Text("%.3g %.3g %.3g %.3g", static_cast<double>(range.min), static_cast<double>(range.max), sums.mean(),
                  sums.rms());
    }
    ImGui::End();
  }

  Load load_;
  std::vector<PlotView> plots_;
  TimeAxis axis_;
  PlotLink link_;
  ItemMap items_;
  Typing typing_;
  Resting resting_;
  std::map<std::string, bool> sections_;
  const ImU32 inks_[4] = {~0u, ~0u, ~0u, ~0u};
  std::vector<float> row_ = std::vector<float>(kMostChannels + 1);
};

/// p50, p99 and worst of `kFrames` frames, with the hand doing `move` before each.
void measure(const std::string& what, const Load& load, double span, const std::function<void(TimeAxis&, int)>& move) {
  PlotBench bench(load);
  bench.frame();
  bench.axis().set_span(span);
  std::vector<double> ms;
  for (int i = 0; i < kFrames; ++i) {
    move(bench.axis(), i);
    ms.push_back(bench.frame());
  }
  std::sort(ms.begin(), ms.end());
  std::printf("| %-9s | %6.0f s | %2zu | %s | %4.0f px | %5.2f | %5.2f | %5.2f |\n", what.c_str(), span * 1e-3,
              load.channels, load.statistics ? "yes" : "no ", static_cast<double>(kWidth) / load.columns,
              ms[kFrames / 2], ms[kFrames * 99 / 100], ms.back());
}

void follow(TimeAxis& axis, int) { axis.follow(); }
void pan(TimeAxis& axis, int frame) {
  const double by = 0.013 * axis.span();
  axis.pan(frame % 100 < 50 ? -by : by);
}
/// In by a notch a frame and out again, about a place that is not the middle.
void zoom(TimeAxis& axis, int frame) {
  axis.hold();
  axis.zoom(frame % 20 < 10 ? 0.8 : 1.25, axis.from() + 0.3 * axis.span());
}

}  // namespace

TEST_CASE("measure: processor time of frames with 1, 8 and 24 channels and an hour of history" * doctest::skip()) {
  HeadlessApp host;  // a font, a style, a frame
  std::printf("| hand      | in view  | channels | numbers | a plot | p50 ms | p99 ms | worst ms |\n");
  for (const double span : {1e3, 3.7e3, 60e3, 600e3, 3600e3}) {
    for (const std::size_t channels : {1u, 8u, 24u}) measure("follow", {.channels = channels}, span, follow);
    measure("follow", {.statistics = true}, span, follow);
    measure("follow", {.columns = 1}, span, follow);
    measure("pan", {}, span, pan);
    measure("pan", {.statistics = true, .columns = 1}, span, pan);
    measure("zoom", {}, span, zoom);
    measure("zoom", {.statistics = true, .columns = 1}, span, zoom);
  }
}
