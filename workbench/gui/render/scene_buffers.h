// GPU buffers of the vertex arrays: upload and draw calls only.
#pragma once

#include "workbench/gui/render/gl_objects.h"
#include "workbench/gui/render/sketch.h"
#include "workbench/gui/render/surface_mesh.h"

#include <span>

namespace tangent {

/// Unindexed facets, three vertices each. Uploaded in slices, as the surface.
class FacetBuffer {
 public:
  void begin_upload(std::vector<FacetVertex> vertices);
  /// Uploads up to `bytes`; true once everything is there.
  bool continue_upload(std::size_t bytes);
  void clear();
  bool pending() const { return !waiting_.empty(); }
  void draw(std::size_t first_triangle, std::size_t triangles) const;
  std::size_t triangles() const { return static_cast<std::size_t>(count_) / 3; }

 private:
  std::vector<FacetVertex> waiting_;  // emptied when uploaded
  std::size_t uploaded_ = 0;
  GlVertexArray array_;
  GlBuffer vertices_;
  GLsizei count_ = 0;
};

/// Indexed surface. Uploaded in slices, so that no frame waits for a large one.
class SurfaceBuffer {
 public:
  void begin_upload(SurfaceMesh mesh);
  /// Uploads up to `bytes`; true once everything is there.
  bool continue_upload(std::size_t bytes);
  void clear();
  void draw() const { draw(0, triangles()); }
  void draw(std::size_t first_triangle, std::size_t triangles) const;
  bool ready() const { return ready_; }
  bool pending() const { return !ready_ && !mesh_.indices.empty(); }
  unsigned level() const { return level_; }
  std::size_t triangles() const { return ready_ ? static_cast<std::size_t>(count_) / 3 : 0; }

 private:
  SurfaceMesh mesh_;  // emptied when uploaded
  std::size_t uploaded_ = 0;
  GlVertexArray array_;
  GlBuffer vertices_, indices_;
  GLsizei count_ = 0;
  unsigned level_ = 1;
  bool ready_ = false;
};

/// Instances of strokes.vert.glsl.
class StrokeBuffer {
 public:
  void upload(std::span<const Stroke> strokes, GLenum usage);
  void draw() const;
  bool empty() const { return count_ == 0; }

 private:
  GlVertexArray array_;
  GlBuffer instances_;
  GLsizei count_ = 0;
};

class FillBuffer {
 public:
  void upload(std::span<const FillVertex> vertices);
  void draw() const;

 private:
  GlVertexArray array_;
  GlBuffer vertices_;
  GLsizei count_ = 0;
};

/// Unit ball, cylinder and cone for solid.vert.glsl.
class SolidBuffer {
 public:
  void create();
  void draw(SolidShape shape) const;

 private:
  struct Range {
    GLint first = 0;
    GLsizei count = 0;
  };
  GlVertexArray array_;
  GlBuffer vertices_;
  std::array<Range, 3> ranges_;
};

}  // namespace tangent
