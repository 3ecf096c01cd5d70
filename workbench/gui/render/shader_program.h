// GLSL programs from files: NAME.vert.glsl and NAME.frag.glsl, `#include "x.glsl"` resolved in the same
// directory. Errors name file and line. A program reloads itself when one of its files changes on disk;
// if the new text doesn't compile, the last good program stays in use.
#pragma once

#include "core/base/result.h"

#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

namespace tangent {

/// Where the shaders are: the source tree this was built from if it is still there, else `shaders` beside
/// the executable or one level up. Fails naming the places tried.
Result<std::filesystem::path> find_shader_directory();

class ShaderProgram {
 public:
  ShaderProgram() = default;
  ShaderProgram(ShaderProgram&& other) noexcept;
  ShaderProgram& operator=(ShaderProgram&& other) noexcept;
  ~ShaderProgram();

  static Result<ShaderProgram> load(const std::filesystem::path& directory, const std::string& name);

  /// Loads again if a file changed since the last try; the error, if any, of that try.
  Status reload_if_changed();

  unsigned id() const { return id_; }
  void use() const;
  // Uniforms of the program in use; unknown names are ignored, as GL does.
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
