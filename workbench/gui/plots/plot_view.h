// A plot of some channels against the shared time axis. The wheel zooms time about the pointer, dragging pans,
// right-dragging selects a time range (and a value range if the box is high), a double-click shows all. Over the value
// labels the wheel zooms the values only, dragging moves them and a double-click fits them again; over the time labels
// wheel and drag do the same to time. A click reports the tick under the pointer; with Ctrl it sets cursor A, with
// Shift cursor B.
#pragma once

#include "workbench/gui/plots/channel_store.h"
#include "workbench/gui/plots/kept_bars.h"
#include "workbench/gui/plots/plot_marks.h"
#include "workbench/gui/plots/time_axis.h"
#include "workbench/gui/plots/value_axis.h"
#include "workbench/gui/widgets/ui_context.h"

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace tangent {

/// A box of at least this height (points) selects values as well as time.
inline constexpr float kHighBox = 14.0f;

struct PlotSeries {
  std::string name;
  std::size_t channel = 0;
  Rgba Palette::*colour = nullptr;
  bool steps = false;  ///< holds its value until the next tick (counts)
  bool visible = true;
  std::optional<std::size_t> ghost = std::nullopt;  ///< channel of PlotLink::ghost drawn with it
  const char* doc = "";                             ///< shown on hover
  std::string key = {};                             ///< the channel as text; what is dragged
  std::string full_name = {};                       ///< "Force x"; `name` is what this plot calls it
  std::string unit = {};
  double scale = 1.0;            ///< displayed = channel value * scale
  const char* format = "%8.3f";  ///< of the value under the cursor
  /// Of a curve with stores of its own: channel 0 of this one, in place of the plot's; and of its ghost. Of this frame.
  const ChannelStore *own = nullptr, *own_ghost = nullptr;

  const ChannelStore& store_in(const ChannelStore& common) const { return own != nullptr ? *own : common; }
  /// Null: it has no ghost.
  const ChannelStore* ghost_in(const ChannelStore* common) const {
    if (own != nullptr) return own_ghost;
    return ghost ? common : nullptr;
  }
};

struct PlotSpec {
  std::string id;  ///< item map: "plots/<id>"
  std::string title;
  std::string unit;    ///< of all its series; empty: they have several, or none
  double scale = 1.0;  ///< of the reference line
  bool log = false;
  bool counts = false;  ///< labels only integers
  bool with_zero = true;
  double floor = 1e-6;                         ///< of a log axis, displayed unit
  std::string nothing = "no samples in view";  ///< text shown when there are no samples
  std::vector<PlotSeries> series;
};

/// State shared by the plots besides their time axis.
struct PlotLink {
  double tick_period_s = 1e-3;
  std::optional<std::uint64_t> cursor;   ///< the tick in view while paused
  std::optional<double> hover;           ///< tick under the pointer in the last frame
  std::optional<double> hover_next;      ///< set while drawing this frame
  std::optional<std::uint64_t> clicked;  ///< the user clicked this tick
  std::optional<std::uint64_t> a, b;     ///< measuring cursors
  const ChannelStore* ghost = nullptr;   ///< the same ticks solved again
  PlotMarks marks;
  struct OnPlot {
    std::string plot;      ///< id
    std::string channels;  ///< keys, one a line
  };
  std::optional<OnPlot> dropped, removed;  ///< what the user did in this frame
};

/// What is dragged onto a plot: keys of channels, one a line.
inline constexpr const char* kChannelPayload = "channels";
/// Makes ImGui's last item a source of it, which says `shown` while it is dragged.
void drag_channels(const std::string& keys, const std::string& shown);

/// Colour of a curve's ghost: its own, nearer to that of text.
ImU32 ghost_ink(const UiContext& ui, const PlotSeries& series);

class PlotView {
 public:
  explicit PlotView(PlotSpec spec) : spec_(std::move(spec)) {}

  const PlotSpec& spec() const { return spec_; }
  PlotSpec& spec() { return spec_; }
  const ValueAxis& values() const { return values_; }
  ValueAxis& values() { return values_; }
  /// The value axis is fitted anew: other curves are in it.
  void refit() { values_.set_automatic(); }

  /// Draws into the rectangle at `pos`. `time_labels`: with the labels of the time axis below; `reference`: value of a
  /// dashed horizontal line, channel units.
  void draw(const UiContext& ui, const ChannelStore& store, TimeAxis& axis, PlotLink& link, ImVec2 pos, ImVec2 size,
            bool time_labels, double reference = std::numeric_limits<double>::quiet_NaN());

 private:
  void draw_header(const UiContext& ui, const ChannelStore& store, PlotLink& link, const PlotArea& area);
  /// Click: hide or show; right-click: remove; drag: onto another plot.
  void touch_legend_entry(const UiContext& ui, PlotSeries& series, PlotLink& link, ImVec2 size);
  void fit(const ChannelStore& store, const TimeAxis& axis, const PlotLink& link, double reference);
  void draw_grid(const UiContext& ui, const TimeAxis& axis, const PlotLink& link, const PlotArea& area,
                 bool time_labels);
  void draw_series(const UiContext& ui, const ChannelStore& store, const TimeAxis& axis, const PlotLink& link,
                   const PlotArea& area);
  struct Curve {
    const ChannelStore& store;
    std::size_t channel;
    KeptBars& kept;
  };
  void draw_curve(const UiContext& ui, Curve curve, const TimeAxis& axis, const PlotArea& area,
                  const PlotSeries& series, ImU32 ink);
  /// Only where it is a pixel or more away from the recorded curve.
  void draw_ghost(const UiContext& ui, Curve recorded, Curve ghost, const TimeAxis& axis, const PlotArea& area,
                  const PlotSeries& series);
  /// Maps a channel's value to y on screen.
  struct ToPixel {
    const ValueAxis* values;
    float lowest, height;
    double scale, gain, offset;
    bool log;
    float operator()(float value) const;
  };
  ToPixel to_pixel(const PlotArea& area, double scale) const;
  void draw_cursors(const UiContext& ui, const TimeAxis& axis, const PlotLink& link, const PlotArea& area,
                    bool time_labels);
  void interact(const UiContext& ui, TimeAxis& axis, PlotLink& link, const PlotArea& area);
  void interact_box(const UiContext& ui, TimeAxis& axis, const PlotArea& area, double under);
  void interact_values(const UiContext& ui, const PlotArea& area);
  void interact_time_labels(const UiContext& ui, TimeAxis& axis, const PlotArea& area);

  PlotSpec spec_;
  ValueAxis values_;
  std::optional<double> box_from_;  ///< tick where the right-drag began,
  float box_y_ = 0.0f;              ///< and its y on screen
  bool dragged_ = false;
  bool nothing_in_view_ = true;
  struct CurveBars {
    KeptBars recorded, ghost;
  };
  std::vector<CurveBars> curves_;  ///< by series
  KeptBars events_;
  std::vector<SamplePoint> points_, below_;
  std::vector<ColumnBar> bars_;
  std::vector<ImVec2> line_;
};

}  // namespace tangent
