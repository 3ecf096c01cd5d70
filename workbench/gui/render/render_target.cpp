#include "workbench/gui/render/render_target.h"

namespace tangent {

Status RenderTarget::resize(int width_px, int height_px, int samples) {
  if (width_px == width_px_ && height_px == height_px_ && samples == samples_) return {};
  width_px_ = width_px, height_px_ = height_px, samples_ = samples;
  framebuffer_.create();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  if (samples > 0) {
    glBindRenderbuffer(GL_RENDERBUFFER, colour_.create());
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_RGBA8, width_px, height_px);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.id());
  } else {
    glBindTexture(GL_TEXTURE_2D, texture_.create());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width_px, height_px, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    // Shown pixel by pixel.
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.id(), 0);
  }
  glBindRenderbuffer(GL_RENDERBUFFER, depth_.create());
  if (samples > 0) {
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, width_px, height_px);
  } else {
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width_px, height_px);
  }
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return {};
  samples_ = -1;
  return fail("the graphics driver refuses an off-screen picture of " + std::to_string(width_px) + " x " +
                  std::to_string(height_px) + " pixels, " + std::to_string(samples) + " samples",
              "3D view", "use a smaller window");
}

void RenderTarget::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glViewport(0, 0, width_px_, height_px_);
}

void RenderTarget::copy_from(const RenderTarget& source) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, source.framebuffer_.id());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.id());
  glBlitFramebuffer(0, 0, width_px_, height_px_, 0, 0, width_px_, height_px_, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT,
                    GL_NEAREST);
}

}  // namespace tangent
