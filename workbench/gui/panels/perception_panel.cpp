// Perceived smoothness: the mesh's angles against the threshold of a rendering condition, as one sentence, a table of
// all conditions and the worst edges. The heat map is the map "Facet angle".
#include "core/io/rendering_condition.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>

namespace tangent {

namespace {

std::size_t chosen_condition(const PresetModel& presets, const PerceptionPanel& state) {
  if (state.condition >= 0) return static_cast<std::size_t>(state.condition);
  const RenderingCondition* own = condition_of(presets.current());
  const std::size_t index =
      own != nullptr ? static_cast<std::size_t>(own - kRenderingConditions.data()) : kArcConditions;
  return index < kArcConditions ? index : 2;  // C3: nothing shaded
}

void draw_choice(const UiContext& ui, MapView& map, PerceptionPanel& state, int chosen) {
  const float width = ImGui::GetContentRegionAvail().x;
  std::array<std::string, kArcConditions> texts;
  std::array<std::string_view, kArcConditions> names;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    texts[i] = std::string(kRenderingConditions[i].name) + ": " + std::string(kRenderingConditions[i].words);
    names[i] = texts[i];
  }
  if (choice_row(ui, "perception/condition", width - ui.px(96), names, chosen)) state.condition = chosen;
  tooltip(ui, "Rendering condition of the verdict and the worst edges; at first the preset's own, else C3");
  ImGui::SameLine(0, ui.px(4));
  bool shown = map.on && map.quantity == MapQuantity::facet_angle;
  if (!toggle_button(
          ui, "perception/map", "Heat map", shown,
          "Colours every triangle by its largest angle to a neighbour; the threshold is marked on the colour bar"))
    return;
  map.on = shown;
  if (shown) map.set_quantity(MapQuantity::facet_angle);
}

/// Threshold, and the share of edges felt, as a bar and as a number.
void draw_table(const UiContext& ui, const PerceptionAudit& audit, std::size_t chosen) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImFont* number = ui.fonts.small_number;
  const float width = ImGui::GetContentRegionAvail().x, height = ui.px(18);
  const float bar_from = ui.px(128), bar_to = width - ui.px(62);
  for (std::size_t i = 0; i < audit.conditions.size(); ++i) {
    const ConditionFeel& feel = audit.conditions[i];
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy({width, height});
    ui.items.note_last(printed("perception/row/%s", std::string(feel.threshold.condition).c_str()));
    tooltip(
        ui,
        printed("%llu of %llu edges of curves, %.4g of %.4g mm of their length; %llu within the threshold's interval",
                static_cast<unsigned long long>(feel.felt), static_cast<unsigned long long>(feel.curve_edges),
                1e3 * feel.felt_length_m, 1e3 * feel.curve_length_m, static_cast<unsigned long long>(feel.doubtful)));
    if (i == chosen) draw.AddRectFilled(at, {at.x + width, at.y + height}, ui.colours.accent_soft, ui.px(2));
    const float y = at.y + 0.5f * (height - number->FontSize);
    draw.AddText(number, number->FontSize, {at.x + ui.px(4), y}, ui.colours.text,
                 std::string(feel.threshold.condition).c_str());
    const std::string threshold =
        printed("%5.1f deg%s", feel.threshold.mean_deg, feel.threshold.interval_deg ? "" : " pilot");
    draw.AddText(number, number->FontSize, {at.x + ui.px(26), y}, i == chosen ? ui.colours.text : ui.colours.text_dim,
                 threshold.c_str());
    const float share = static_cast<float>(feel.felt_share());
    draw.AddRectFilled({at.x + bar_from, at.y + ui.px(5)}, {at.x + bar_to, at.y + height - ui.px(5)}, ui.colours.field,
                       ui.px(2));
    if (share > 0.0f) {
      const float end = bar_from + std::max(ui.px(2), share * (bar_to - bar_from));
      draw.AddRectFilled({at.x + bar_from, at.y + ui.px(5)}, {at.x + end, at.y + height - ui.px(5)}, ui.colours.warning,
                         ui.px(2));
    }
    const std::string text = printed("%.2f %%", 100.0 * feel.felt_share());
    const float w = number->CalcTextSizeA(number->FontSize, 1e9f, 0.0f, text.c_str()).x;
    draw.AddText(number, number->FontSize, {at.x + width - w - ui.px(4), y},
                 share > 0.0f || i == chosen ? ui.colours.text : ui.colours.text_dim, text.c_str());
  }
}

void draw_worst(const UiContext& ui, AppModel& model, const ConditionFeel& feel) {
  if (feel.worst.empty()) return;
  ImGui::TextDisabled("Sharpest edges under %s", std::string(feel.threshold.condition).c_str());
  tooltip(ui, "A click goes there");
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImFont* number = ui.fonts.small_number;
  const ContactMesh& mesh = model.scene().current()->mesh();
  const float width = ImGui::GetContentRegionAvail().x, height = ui.px(18);
  for (std::size_t i = 0; i < std::min<std::size_t>(5, feel.worst.size()); ++i) {
    const FeltEdge& edge = feel.worst[i];
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::InvisibleButton(printed("##felt%zu", i).c_str(), {width, height}))
      model.view().look_at_place(edge.middle_m, mesh.normal(edge.triangle, edge.edge), edge.triangle);
    ui.items.note_last(printed("perception/worst/%zu", i));
    if (ImGui::IsItemHovered()) draw.AddRectFilled(at, {at.x + width, at.y + height}, ui.colours.accent_soft, ui.px(2));
    const std::string text = printed("%7.2f deg  %7.3f mm long", edge.angle_deg, 1e3 * edge.length_m),
                      where = printed("triangle %u", edge.triangle);
    draw.AddText(number, number->FontSize, {at.x + ui.px(4), at.y + ui.px(3)}, ui.colours.text, text.c_str());
    const float w = number->CalcTextSizeA(number->FontSize, 1e9f, 0.0f, where.c_str()).x;
    draw.AddText(number, number->FontSize, {at.x + width - w - ui.px(4), at.y + ui.px(3)}, ui.colours.text_dim,
                 where.c_str());
  }
}

}  // namespace

double felt_angle_rad(const PresetModel& presets, const PerceptionPanel& state) {
  return kPerceptionThresholds[chosen_condition(presets, state)].mean_deg * kDegree;
}

void draw_perception_panel(const UiContext& ui, AppModel& model, PerceptionPanel& state) {
  if (!section(ui, "Smoothness as felt", state.open)) return;
  if (model.scene().current() != nullptr && model.scene().current()->planar() != nullptr) {
    ImGui::TextDisabled("For meshes; this is a 2D scene");
    return;
  }
  const PerceptionAudit* audit = model.scene().perception();
  if (audit == nullptr) {
    ImGui::TextDisabled(model.scene().auditing() ? "Audit running" : "No mesh");
    return;
  }
  const std::size_t chosen = chosen_condition(model.presets(), state);
  draw_choice(ui, model.map(), state, static_cast<int>(chosen));
  std::string sentence = verdict(*audit, static_cast<int>(chosen));
  sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(sentence.c_str());
  ImGui::PopTextWrapPos();
  ui.items.note_last("perception/verdict");
  tooltip(ui, "What a finger feels of this mesh: edges of curves whose angle is above the condition's threshold");
  draw_table(ui, *audit, chosen);
  fact(ui, "Edges of curves", printed("%llu", static_cast<unsigned long long>(audit->curve_edges)));
  fact(ui, "Flat, crease, boundary",
       printed("%llu, %llu, %llu", static_cast<unsigned long long>(audit->flat_edges),
               static_cast<unsigned long long>(audit->crease_edges),
               static_cast<unsigned long long>(audit->boundary_edges)));
  tooltip(ui, "Left out: edges inside flat faces, edges that are meant to be felt, and ends of the surface");
  draw_worst(ui, model, audit->conditions[chosen]);
  ImGui::Dummy({1, ui.px(3)});
}

}  // namespace tangent
