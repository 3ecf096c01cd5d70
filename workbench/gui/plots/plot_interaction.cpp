// Mouse input of a plot.
#include "workbench/gui/plots/plot_view.h"

#include <algorithm>
#include <cmath>

namespace tangent {

void PlotView::interact(const UiContext& ui, TimeAxis& axis, PlotLink& link, const PlotArea& area) {
  const ImGuiIO& io = ImGui::GetIO();
  ImGui::SetCursorScreenPos(area.min);
  ImGui::InvisibleButton("area", {area.width(), area.height()},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
  ui.items.note_last("plots/" + spec_.id);
  if (ImGui::BeginDragDropTarget()) {
    if (const ImGuiPayload* payload = ImGui::AcceptDragDropPayload(kChannelPayload))
      link.dropped = PlotLink::OnPlot{
          spec_.id, std::string(static_cast<const char*>(payload->Data), static_cast<std::size_t>(payload->DataSize))};
    ImGui::EndDragDropTarget();
  }
  const double under = axis.tick_at(static_cast<double>(io.MousePos.x), static_cast<double>(area.min.x),
                                    static_cast<double>(area.width()));
  if (ImGui::IsItemHovered()) {
    link.hover_next = under;
    if (io.MouseWheel != 0.0f) {
      axis.zoom(std::pow(0.8, static_cast<double>(io.MouseWheel)), under);
      // Consumes the wheel, so that the panel below does not scroll as well.
      ImGui::GetIO().MouseWheel = 0.0f;
    }
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
      axis.show_all();
      values_.set_automatic();
    }
  }
  if (ImGui::IsItemActivated()) dragged_ = false;
  if (ImGui::IsItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    if (ImGui::IsMouseDragging(ImGuiMouseButton_Left, ui.px(4))) dragged_ = true;
    if (dragged_ && io.MouseDelta.x != 0.0f) {
      axis.pan(-static_cast<double>(io.MouseDelta.x / area.width()) * axis.span());
    }
  }
  if (ImGui::IsItemDeactivated() && !dragged_ && ImGui::IsMouseReleased(ImGuiMouseButton_Left) &&
      !ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && under >= 0.0) {
    const auto tick = static_cast<std::uint64_t>(under + 0.5);
    if (io.KeyCtrl)
      link.a = tick;
    else if (io.KeyShift)
      link.b = tick;
    else
      link.clicked = tick;
  }
  if (ImGui::IsItemHovered() && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
    box_from_ = under;
    box_y_ = io.MousePos.y;
  }
  if (box_from_ && !ImGui::IsMouseDown(ImGuiMouseButton_Right)) interact_box(ui, axis, area, under);
}

/// End of a right-drag box. A high box also selects values.
void PlotView::interact_box(const UiContext& ui, TimeAxis& axis, const PlotArea& area, double under) {
  const float y = std::clamp(ImGui::GetIO().MousePos.y, area.min.y, area.max.y);
  const double from = *box_from_;
  box_from_.reset();
  if (std::abs(under - from) / axis.span() <= 0.01) return;
  if (std::abs(y - box_y_) > ui.px(kHighBox)) {
    const auto value = [&](float at) {
      return values_.value_at(static_cast<double>((area.max.y - at) / area.height()), spec_.log);
    };
    values_.show(value(std::max(y, box_y_)), value(std::min(y, box_y_)));
  }
  axis.show(std::min(under, from), std::max(under, from));
}

void PlotView::interact_values(const UiContext& ui, const PlotArea& area) {
  ImGui::SetCursorScreenPos({area.pos.x, area.min.y});
  ImGui::InvisibleButton("values", {area.gutter - ui.px(2), area.height()});
  ui.items.note_last("plots/" + spec_.id + "/values");
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemActive() && io.MouseDelta.y != 0.0f)
    values_.pan(static_cast<double>(io.MouseDelta.y / area.height()), spec_.log);
  if (!ImGui::IsItemHovered()) return;
  ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNS);
  if (io.MouseWheel != 0.0f) {
    const double share = static_cast<double>((area.max.y - io.MousePos.y) / area.height());
    values_.zoom(std::pow(0.8, static_cast<double>(io.MouseWheel)), values_.value_at(share, spec_.log), spec_.log);
    ImGui::GetIO().MouseWheel = 0.0f;
  }
  if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) values_.set_automatic();
}

void PlotView::interact_time_labels(const UiContext& ui, TimeAxis& axis, const PlotArea& area) {
  ImGui::SetCursorScreenPos({area.min.x, area.bottom() + ui.px(1)});
  ImGui::InvisibleButton("time", {area.width(), std::max(1.0f, area.pos.y + area.size.y - area.bottom() - ui.px(2))});
  ui.items.note_last("plots/" + spec_.id + "/time");
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemActive() && io.MouseDelta.x != 0.0f)
    axis.pan(-static_cast<double>(io.MouseDelta.x / area.width()) * axis.span());
  if (!ImGui::IsItemHovered()) return;
  ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (io.MouseWheel != 0.0f) {
    axis.zoom(std::pow(0.8, static_cast<double>(io.MouseWheel)),
              axis.tick_at(static_cast<double>(io.MousePos.x), static_cast<double>(area.min.x),
                           static_cast<double>(area.width())));
    ImGui::GetIO().MouseWheel = 0.0f;
  }
  if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) axis.show_all();
}

}  // namespace tangent
