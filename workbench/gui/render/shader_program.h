// GLSL programs from files NAME.vert.glsl and NAME.frag.glsl; `#include "x.glsl"` is resolved in the same folder.
// Errors name file and line. A program can reload when one of its files changes on disk; if the new text does not
// compile, the last working program stays in use.
#pragma once

#include "core/base/result.h"

#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

namespace tangent {

/// Folder of the shaders: in the source tree of the build if it still exists, else `shaders` beside the executable or
/// one level up. Fails, naming the places tried.
Result<std::filesystem::path> find_shader_directory();

class ShaderProgram {
 public:
  ShaderProgram() = default;
  ShaderProgram(ShaderProgram&& other) noexcept;
  ShaderProgram& operator=(ShaderProgram&& other) noexcept;
  ~ShaderProgram();

  static Result<ShaderProgram> load(const std::filesystem::path& directory, const std::string& name);

  /// Reloads if a file changed since the last attempt. Fails with the compiler's message.
  Status reload_if_changed();

  unsigned id() const { return id_; }
  void use() const;
  // Uniforms of the program in use; unknown names are ignored, as in GL.
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, const glm::vec2& value) const;
  void set(const char* name, const glm::vec3& value) const;
  void set(const char* name, const glm::vec4& value) const;
  void set(const char* name, const glm::mat3& value) const;
  void set(const char* name, const glm::mat4& value) const;

 private:
  struct Source {
    std::filesystem::path path;
    std::filesystem::file_time_type written;
  };
  std::filesystem::path directory_;
  std::string name_;
  unsigned id_ = 0;
  std::vector<Source> sources_;
};

}  // namespace tangent
