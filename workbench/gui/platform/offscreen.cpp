#include "workbench/gui/platform/offscreen.h"

#include "workbench/gui/platform/ui_drawing.h"
#include "workbench/gui/render/render_target.h"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <imgui.h>

#include <array>
#include <cstdlib>
#include <utility>

namespace tangent {
namespace {

tl::unexpected<Error> no_gl(const std::string& what) {
  return fail("no off-screen OpenGL: " + what, "EGL", "install a GL driver, e.g. the package libgl1-mesa-dri");
}

EGLDisplay surfaceless_display() {
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) return EGL_NO_DISPLAY;
  return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

}  // namespace

Result<OffscreenContext> OffscreenContext::open() {
  if (!epoxy_has_egl()) return no_gl("the EGL library is missing");
  const EGLDisplay display = surfaceless_display();
  if (display == EGL_NO_DISPLAY) return no_gl("EGL has no surfaceless platform");
  if (!eglInitialize(display, nullptr, nullptr)) return no_gl("EGL does not start");
  if (!eglBindAPI(EGL_OPENGL_API)) return no_gl("EGL offers no desktop OpenGL");
  constexpr std::array<EGLint, 5> kConfig{EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display, kConfig.data(), &config, 1, &count) || count < 1) return no_gl("no fitting EGL config");
  constexpr std::array<EGLint, 7> kContext{
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, kContext.data());
  if (context == EGL_NO_CONTEXT) return no_gl("the driver has no OpenGL 3.3 core");
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
    eglDestroyContext(display, context);
    return no_gl("the driver can't draw without a surface");
  }
  return OffscreenContext(display, context);
}

OffscreenContext::OffscreenContext(OffscreenContext&& other) noexcept
    : display_(std::exchange(other.display_, nullptr)), context_(std::exchange(other.context_, nullptr)) {}

OffscreenContext::~OffscreenContext() {
  if (context_ == nullptr) return;
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  // Not eglTerminate: the EGL display is shared by all contexts of the process.
}

struct OffscreenScreen::Impl {
  explicit Impl(OffscreenContext c) : context(std::move(c)) {}
  OffscreenContext context;  // outlives all GL objects
  RenderTarget screen;
  ImGuiContext* imgui = nullptr;
};

OffscreenScreen::OffscreenScreen(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Result<std::unique_ptr<OffscreenScreen>> OffscreenScreen::open(int width_px, int height_px) {
  Result<OffscreenContext> context = OffscreenContext::open();
  if (!context) return tl::unexpected(context.error());
  auto impl = std::make_unique<Impl>(std::move(*context));
  if (Status sized = impl->screen.resize(width_px, height_px, 0); !sized) return tl::unexpected(sized.error());
  impl->imgui = ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.DisplaySize = {static_cast<float>(width_px), static_cast<float>(height_px)};
  ImGui::GetStyle().AntiAliasedLinesUseTex = false;  // the atlas is read by nearest pixel (ui_drawing.h)
  // Now, not in the first frame: that would put back how the atlas is read.
  if (!ImGui_ImplOpenGL3_Init("#version 330 core") || !ImGui_ImplOpenGL3_CreateDeviceObjects())
    return no_gl("the drawing back end does not start");
  return std::unique_ptr<OffscreenScreen>(new OffscreenScreen(std::move(impl)));
}

OffscreenScreen::~OffscreenScreen() {
  ImGui::SetCurrentContext(impl_->imgui);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(impl_->imgui);
}

void OffscreenScreen::upload_fonts() {
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
  use_nearest_pixels(font_texture());
}

void OffscreenScreen::frame(const std::function<void()>& build, const ImVec4& ground) {
  ImGui::SetCurrentContext(impl_->imgui);
  impl_->screen.bind();
  ImGui_ImplOpenGL3_NewFrame();
  build();
  impl_->screen.bind();
  UiDrawing::draw(*ImGui::GetDrawData(), ground);
  // Nothing is swapped here, and until it has to, a software driver keeps every frame's buffers: 4 MB each.
  glFinish();
}

void OffscreenScreen::unseen_frame(const std::function<void()>& build) {
  ImGui::SetCurrentContext(impl_->imgui);
  ImGui_ImplOpenGL3_NewFrame();
  build();
}

Image OffscreenScreen::picture() const {
  return read_pixels(impl_->screen.framebuffer(), impl_->screen.width_px(), impl_->screen.height_px());
}

}  // namespace tangent
