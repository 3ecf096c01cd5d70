// An off-screen framebuffer: RGBA8 colour and 24-bit depth, optionally multisampled, resized on demand.
#pragma once

#include "core/base/result.h"
#include "workbench/gui/render/gl_objects.h"

namespace tangent {

class RenderTarget {
 public:
  /// samples 0: a texture; otherwise a multisampled renderbuffer. Fails when the driver refuses the size.
  Status resize(int width_px, int height_px, int samples);
  void bind() const;  ///< for drawing, viewport included
  /// Copies (and resolves) colour and depth of `source`, of the same size.
  void copy_from(const RenderTarget& source) const;

  GLuint framebuffer() const { return framebuffer_.id(); }
  GLuint texture() const { return texture_.id(); }
  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  int samples() const { return samples_; }

 private:
  GlFramebuffer framebuffer_;
  GlTexture texture_;
  GlRenderbuffer colour_, depth_;
  int width_px_ = 0, height_px_ = 0, samples_ = -1;
};

}  // namespace tangent
