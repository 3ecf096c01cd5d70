// The GPU side of surface_paint.h: texture buffers for values, mask and sources, and the colours as a texture.
#pragma once

#include "core/mesh/contact_mesh.h"
#include "workbench/gui/render/gl_objects.h"
#include "workbench/gui/render/shader_program.h"
#include "workbench/gui/render/surface_paint.h"

#include <memory>

namespace tangent {

/// An array that shaders read by index (GL_TEXTURE_BUFFER).
class IndexedBuffer {
 public:
  void upload(const void* data, std::size_t bytes, GLenum format);
  void bind(unsigned unit) const;

 private:
  GlBuffer buffer_;
  GlTexture texture_;
};

class PaintBuffers {
 public:
  void create();
  /// Uploads what has changed.
  void take(const std::optional<MapPaint>& map, const std::shared_ptr<const Isolation>& isolation,
            const ContactMesh& mesh);
  /// Sets map, isolation and slice of the program in use; call it whenever a program of facets or surface is used.
  /// `slice`: in the program's coordinates; keeps points with dot(slice, (p, 1)) >= 0. `map`: whether to show the map,
  /// if there is one.
  void apply(const ShaderProgram& program, bool map, Rgba pending, Rgba none) const;

 private:
  void upload_colours(ColourMap map, bool reversed);

  std::optional<MapPaint> map_;
  std::optional<std::uint64_t> uploaded_values_, uploaded_mask_;
  bool isolated_ = false;
  IndexedBuffer values_, kept_, no_sources_;
  GlTexture colours_;
};

/// Texture unit of the sources, which stand-ins bind themselves.
inline constexpr unsigned kSourcesUnit = 4;

}  // namespace tangent
