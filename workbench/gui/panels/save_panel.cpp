#include "workbench/gui/panels/save_panel.h"

#include "workbench/gui/model/export_tables.h"
#include "workbench/gui/model/file_origin_of.h"
#include "workbench/gui/panels/plot_figure.h"
#include "workbench/gui/panels/session_view.h"
#include "workbench/gui/widgets/widgets.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>

namespace tangent {
namespace {

constexpr const char* kTitles[]{"Save plots", "Save map", "Save planes", "Save picture of the scene", "Save session"};

/// By gnuplot, which takes a second or more: in a thread of its own.
Status draw_plots(AppModel& model, const PlotsPanel& plots, const std::filesystem::path& file) {
  Result<Figure> figure = plot_figure(plots, model.time());
  if (!figure) return tl::unexpected(figure.error());
  model.exports().start(file.filename().string(),
                        [figure = std::move(*figure), origin = file_origin(model),
                         file](const std::stop_token& stop) -> Result<std::string> {
                          if (Status drawn = write_drawing(figure, origin, file, stop); !drawn)
                            return tl::unexpected(drawn.error());
                          return "written to " + file.string();
                        });
  return {};
}

void draw_entries(const UiContext& ui, SaveDialog& dialog, float height) {
  ImGui::BeginChild("entries", {0, height}, true);
  const std::vector<SaveDialog::Entry> entries = dialog.entries();  // going into a folder changes them
  for (const SaveDialog::Entry& entry : entries) {
    if (ImGui::Selectable((entry.name + (entry.is_folder ? "/" : "")).c_str())) dialog.choose(entry);
    ui.items.note_last("save/entry/" + entry.name);
  }
  if (entries.empty()) ImGui::TextDisabled("no folders, and no files of this kind");
  ImGui::EndChild();
}

void draw_endings(const UiContext& ui, SaveDialog& dialog) {
  for (std::size_t i = 0; i < dialog.endings().size() && dialog.endings().size() > 1; ++i) {
    bool on = dialog.ending() == i;
    const std::string text = dialog.endings()[i].substr(1);
    if (toggle_button(ui, "save/ending/" + text, text.c_str(), on, "Kind of file")) dialog.set_ending(i);
    ImGui::SameLine(0, ui.px(3));
  }
}

void draw_picture_options(const UiContext& ui, SaveDialog& dialog) {
  ImGui::SetNextItemWidth(ui.px(90));
  ImGui::InputInt("##width", &dialog.width_px, 0);
  ui.items.note_last("save/width");
  dialog.width_px = std::clamp(dialog.width_px, 16, 8192);
  tooltip(ui, "Pixels, up to 8192; the height follows from the view's");
  ImGui::SameLine(0, ui.px(4));
  ImGui::TextDisabled("px wide");
  ImGui::SameLine(0, ui.px(8));
  toggle_button(ui, "save/transparent", "Transparent", dialog.transparent, "Nothing behind the scene");
  ImGui::SameLine(0, ui.px(3));
  toggle_button(ui, "save/overlay", "Labels", dialog.overlay, "With labels, scales, colour bar and display, as shown");
  ImGui::SameLine(0, ui.px(8));
}

/// Whether it is to be saved now.
bool draw_contents(const UiContext& ui, SaveDialog& dialog, float height) {
  ImGui::TextUnformatted(kTitles[static_cast<std::size_t>(dialog.what())]);
  if (text_button(ui, "save/up", "Up", "To the parent folder")) dialog.up();
  ImGui::SameLine(0, ui.px(8));
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", dialog.folder().c_str());
  const float line = ImGui::GetFrameHeightWithSpacing();
  draw_entries(ui, dialog, height - 5.2f * line);
  ImGui::SetNextItemWidth(-1.0f);
  const bool enter = ImGui::InputText("##save_name", &dialog.name, ImGuiInputTextFlags_EnterReturnsTrue);
  ui.items.note_last("save/name");
  tooltip(ui, "A name, or a path relative to this folder or from / or ~. The path of a folder opens it");
  const bool replaces = dialog.asks_to_replace();
  const std::string said = replaces ? "This file exists; Replace overwrites it" : dialog.problem();
  ImGui::PushStyleColor(ImGuiCol_Text, replaces ? ui.colours.warning : ui.colours.bad);
  ImGui::TextUnformatted(said.c_str());
  ImGui::PopStyleColor();
  draw_endings(ui, dialog);
  if (dialog.what() == SaveWhat::scene) draw_picture_options(ui, dialog);
  const bool pressed = text_button(ui, "save/accept", replaces ? "Replace" : "Save",
                                   replaces ? "Overwrites the file of this name" : "Saves the file");
  ImGui::SameLine(0, ui.px(8));
  if (text_button(ui, "save/cancel", "Cancel", "Closes without saving (Esc)")) dialog.close();
  return enter || pressed;
}

}  // namespace

void save_file(AppModel& model, const PlotsPanel& plots, SaveWhat what, const std::filesystem::path& file) {
  if (what == SaveWhat::scene)  // by the panel that has the renderer, in the next frame
    return model.exports().ask_for_scene({file, model.exports().dialog().width_px, model.exports().dialog().transparent,
                                          model.exports().dialog().overlay});
  const Status written = what == SaveWhat::map       ? write_map_table(model, file)
                         : what == SaveWhat::planes  ? write_planes_table(model, file)
                         : what == SaveWhat::session ? save_session(model, plots, file)
                                                     : draw_plots(model, plots, file);
  if (!written)
    model.messages().say(Severity::error, written.error().message());
  else if (what != SaveWhat::plots)
    model.messages().say(Severity::note, "written to " + file.string());
}

void ask_to_save(AppModel& model, SaveWhat what) {
  constexpr const char* kNames[]{"plots", "map", "planes", "scene", "workbench"};
  const std::filesystem::path& folder = model.exports().folder();
  std::vector<std::string> endings{".csv"};
  if (what == SaveWhat::plots) endings = {".svg", ".pdf"};
  if (what == SaveWhat::scene) endings = {".png"};
  if (what == SaveWhat::session) endings = {kSessionEnding};
  model.exports().dialog().ask(what, folder, kNames[static_cast<std::size_t>(what)], std::move(endings));
}

void draw_save_panel(const UiContext& ui, AppModel& model, const PlotsPanel& plots, const Rect& over) {
  SaveDialog& dialog = model.exports().dialog();
  if (!dialog.is_open()) return;
  const ImVec2 size{std::min(ui.px(520), over.w), std::min(ui.px(380), over.h)};
  ImGui::SetNextWindowPos({over.x + 0.5f * (over.w - size.x), over.y + 0.5f * (over.h - size.y)});
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  ImGui::Begin("##save", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  const bool now = draw_contents(ui, dialog, ImGui::GetContentRegionAvail().y);
  ImGui::End();
  ImGui::PopStyleVar();
  if (ImGui::IsKeyPressed(ImGui::GetIO().KeyMap[ImGuiKey_Escape], false)) dialog.close();
  if (!now) return;
  if (const auto file = dialog.accept()) save_file(model, plots, dialog.what(), *file);
}

}  // namespace tangent
