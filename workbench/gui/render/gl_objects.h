// RAII owners of OpenGL names: created on demand, deleted with the object. The creating context must be current when
// they are destroyed.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <utility>

namespace tangent {

/// Create and Destroy take (1, &name) as glGen* and glDelete* do.
template <class Kind>
class GlName {
 public:
  GlName() = default;
  GlName(GlName&& other) noexcept : id_(std::exchange(other.id_, 0u)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~GlName() { reset(); }

  GLuint id() const { return id_; }
  GLuint create() {
    if (id_ == 0) Kind::create(&id_);
    return id_;
  }
  void reset() {
    if (id_ != 0) Kind::destroy(&id_);
    id_ = 0;
  }

 private:
  GLuint id_ = 0;
};

struct BufferKind {
  static void create(GLuint* id) { glGenBuffers(1, id); }
  static void destroy(const GLuint* id) { glDeleteBuffers(1, id); }
};
struct VertexArrayKind {
  static void create(GLuint* id) { glGenVertexArrays(1, id); }
  static void destroy(const GLuint* id) { glDeleteVertexArrays(1, id); }
};
struct TextureKind {
  static void create(GLuint* id) { glGenTextures(1, id); }
  static void destroy(const GLuint* id) { glDeleteTextures(1, id); }
};
struct RenderbufferKind {
  static void create(GLuint* id) { glGenRenderbuffers(1, id); }
  static void destroy(const GLuint* id) { glDeleteRenderbuffers(1, id); }
};
struct FramebufferKind {
  static void create(GLuint* id) { glGenFramebuffers(1, id); }
  static void destroy(const GLuint* id) { glDeleteFramebuffers(1, id); }
};

using GlBuffer = GlName<BufferKind>;
using GlVertexArray = GlName<VertexArrayKind>;
using GlTexture = GlName<TextureKind>;
using GlRenderbuffer = GlName<RenderbufferKind>;
using GlFramebuffer = GlName<FramebufferKind>;

/// One attribute of an interleaved vertex, for the bound array buffer and vertex array.
inline void vertex_attribute(GLuint index, GLint components, GLenum type, bool normalised, std::size_t stride,
                             std::size_t offset) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, components, type, normalised ? GL_TRUE : GL_FALSE, static_cast<GLsizei>(stride),
                        reinterpret_cast<const void*>(offset));
}

}  // namespace tangent
