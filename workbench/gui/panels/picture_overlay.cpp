#include "workbench/gui/panels/picture_overlay.h"

#include "workbench/gui/panels/panels.h"
#include "workbench/gui/render/opaque_image.h"
#include "workbench/gui/render/render_target.h"
#include "workbench/gui/render/scene_overlay.h"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>

#include <map>

namespace tangent {
namespace {

/// RAII: an ImGui context that is current, with fonts of its own; afterwards the one before is current again.
class ContextOfItsOwn {
 public:
  ContextOfItsOwn() : before_(ImGui::GetCurrentContext()), own_(ImGui::CreateContext()) {
    ImGui::SetCurrentContext(own_);
    ImGui::GetIO().IniFilename = nullptr;
    ready_ = ImGui_ImplOpenGL3_Init("#version 330 core");
  }
  ~ContextOfItsOwn() {
    if (ready_) ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext(own_);
    ImGui::SetCurrentContext(before_);
  }
  ContextOfItsOwn(const ContextOfItsOwn&) = delete;
  ContextOfItsOwn& operator=(const ContextOfItsOwn&) = delete;
  bool ready() const { return ready_; }

 private:
  ImGuiContext* before_;
  ImGuiContext* own_;
  bool ready_ = false;
};

void build_overlay(AppModel& model, const SceneRenderer& renderer, const SceneFrame& frame, const Camera& camera,
                   const ThemeFonts& fonts) {
  const auto width = static_cast<float>(renderer.width_px()), height = static_cast<float>(renderer.height_px());
  ItemMap items;
  Typing typing;
  Resting resting;
  std::map<std::string, bool> sections;
  const UiContext ui{items,
                     typing,
                     resting,
                     theme_colours(frame.theme),
                     palette(frame.theme),
                     fonts,
                     sections,
                     static_cast<float>(frame.pixel_scale)};
  ImGui::NewFrame();
  ImGui::SetNextWindowPos({0.0f, 0.0f});
  ImGui::SetNextWindowSize({width, height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::Begin("##picture", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoInputs);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  add_opaque_image(list, renderer.texture(), {0.0f, 0.0f}, {width, height});
  draw_scene_overlay(list, {0.0f, 0.0f}, 1.0, 0.0f, renderer, frame, camera, fonts);
  draw_map_bar(ui, model, {0.0f, 0.0f, width, height}, ui.px(8));
  ImGui::End();
  ImGui::PopStyleVar();
  ImGui::Render();
}

}  // namespace

Result<Image> with_overlay(AppModel& model, const SceneRenderer& renderer, const SceneFrame& frame,
                           const Camera& camera) {
  const int width = renderer.width_px(), height = renderer.height_px();
  RenderTarget target;
  if (Status sized = target.resize(width, height, 0); !sized) return tl::unexpected(sized.error());
  const ContextOfItsOwn context;
  if (!context.ready()) return fail("the drawing back end does not start", "picture", "save it without labels");
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  apply_theme(frame.theme, static_cast<float>(frame.pixel_scale));
  std::vector<std::string> missing;  // said when the window was opened
  const ThemeFonts fonts = load_fonts(static_cast<float>(frame.pixel_scale), missing);
  ImGui_ImplOpenGL3_NewFrame();
  build_overlay(model, renderer, frame, camera, fonts);
  target.bind();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  Image image = read_pixels(target.framebuffer(), width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  return image;
}

}  // namespace tangent
