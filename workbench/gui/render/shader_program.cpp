#include "workbench/gui/render/shader_program.h"

#include <epoxy/gl.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>

namespace tangent {
namespace {

namespace fs = std::filesystem;

using Files = std::vector<fs::path>;

// Line n of files[i] is compiled as line i * kLinesAFile + n. GLSL has a source-string number for this, but
// Mesa 22.3 leaves it out of half of its messages.
constexpr std::size_t kLinesAFile = 100'000;

/// A line, read from the front.
class LineReader {
 public:
  explicit LineReader(std::string_view line) : rest_(line) {}
  std::string_view rest() const { return rest_; }
  bool take(std::string_view text) {
    if (!rest_.starts_with(text)) return false;
    rest_.remove_prefix(text.size());
    return true;
  }
  std::string_view take_while(std::string_view characters) { return take_first(rest_.find_first_not_of(characters)); }
  std::string_view take_until(char end) { return take_first(rest_.find(end)); }
  std::string_view blanks() { return take_while(" \t\r\f\v"); }
  std::string_view digits() { return take_while("0123456789"); }

 private:
  std::string_view take_first(std::size_t count) {
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(taken.size());
    return taken;
  }
  std::string_view rest_;
};

/// "x.glsl" of a line `#include "x.glsl"`.
std::optional<std::string> included_file(std::string_view line) {
  LineReader reader(line);
  reader.blanks();
  if (!reader.take("#include") || reader.blanks().empty() || !reader.take("\"")) return std::nullopt;
  const std::string_view name = reader.take_until('"');
  if (name.empty() || !reader.take("\"")) return std::nullopt;
  reader.blanks();
  return reader.rest().empty() ? std::optional<std::string>(name) : std::nullopt;
}

// Appends `path` with its includes.
Status append_source(const fs::path& path, Files& files, std::string& text) {
  std::ifstream in(path);
  if (!in) return fail("can't read the shader", path.string(), "restore the file, or reinstall");
  const std::size_t number = files.size();
  files.push_back(path);
  std::string line;
  for (std::size_t n = 1; std::getline(in, line); ++n) {
    const std::optional<std::string> included = included_file(line);
    if (!included) {
      text += line + '\n';
      continue;
    }
    if (files.size() > 16) return fail("includes nest too deep", path.string() + ":" + std::to_string(n));
    text += "#line " + std::to_string(files.size() * kLinesAFile + 1) + '\n';
    if (Status s = append_source(path.parent_path() / *included, files, text); !s) return s;
    text += "#line " + std::to_string(number * kLinesAFile + n + 1) + '\n';
  }
  return {};
}

struct CompilerMessage {
  std::size_t line = 0;
  std::string text;
};

// Drivers write "0:12(5): error: ..." (Mesa), "0(12) : error ..." (NVIDIA) or "ERROR: 0:12: ...": source string, line,
// perhaps the column, what is wrong.
std::optional<CompilerMessage> parse_message(std::string_view line) {
  LineReader reader(line);
  if (reader.take("ERROR:")) reader.blanks();
  if (reader.digits().empty() || !(reader.take(":") || reader.take("("))) return std::nullopt;
  const std::string_view number = reader.digits();
  if (number.empty() || number.size() > 9) return std::nullopt;
  reader.take(")");
  if (reader.take("(") && (reader.digits().empty() || !reader.take(")"))) return std::nullopt;
  reader.blanks();
  if (!reader.take(":")) return std::nullopt;
  reader.blanks();
  return CompilerMessage{std::stoul(std::string(number)), std::string(reader.rest())};
}

Error compile_error(const std::string& log, const Files& files) {
  std::istringstream lines(log);
  std::string line;
  while (std::getline(lines, line)) {
    const std::optional<CompilerMessage> message = parse_message(line);
    if (!message) continue;
    const std::size_t file = std::min(message->line / kLinesAFile, files.size() - 1);
    return {message->text, files[file].string() + ":" + std::to_string(message->line % kLinesAFile), "mend the shader"};
  }
  return {log.empty() ? "does not compile" : log.substr(0, log.find('\n')), files.front().string(), "mend the shader"};
}

Result<GLuint> compile(GLenum stage, const fs::path& path, Files& all_files) {
  Files files;
  std::string text;
  if (Status s = append_source(path, files, text); !s) return tl::unexpected(s.error());
  all_files.insert(all_files.end(), files.begin(), files.end());
  const GLuint shader = glCreateShader(stage);
  const char* pointer = text.c_str();
  glShaderSource(shader, 1, &pointer, nullptr);
  glCompileShader(shader);
  GLint good = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == GL_TRUE) return shader;
  std::string log(4096, '\0');
  GLsizei length = 0;
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  glDeleteShader(shader);
  log.resize(static_cast<std::size_t>(std::max(length, 0)));
  return tl::unexpected(compile_error(log, files));
}

Result<GLuint> link(GLuint vertex, GLuint fragment, const std::string& where) {
  const GLuint program = glCreateProgram();
  glAttachShader(program, vertex);
  glAttachShader(program, fragment);
  glLinkProgram(program);
  GLint good = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (good == GL_TRUE) return program;
  std::string log(4096, '\0');
  GLsizei length = 0;
  glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), &length, log.data());
  glDeleteProgram(program);
  log.resize(static_cast<std::size_t>(std::max(length, 0)));
  return fail("does not link: " + log.substr(0, log.find('\n')), where, "mend the shader");
}

Result<GLuint> build(const fs::path& directory, const std::string& name, Files& files) {
  const fs::path vertex_path = directory / (name + ".vert.glsl");
  const Result<GLuint> vertex = compile(GL_VERTEX_SHADER, vertex_path, files);
  const Result<GLuint> fragment = compile(GL_FRAGMENT_SHADER, directory / (name + ".frag.glsl"), files);
  Result<GLuint> program = !vertex ? vertex : !fragment ? fragment : link(*vertex, *fragment, vertex_path.string());
  if (vertex) glDeleteShader(*vertex);
  if (fragment) glDeleteShader(*fragment);
  return program;
}

fs::file_time_type written(const fs::path& path) {
  std::error_code failed;
  const auto time = fs::last_write_time(path, failed);
  return failed ? fs::file_time_type::min() : time;
}

}  // namespace

Result<fs::path> find_shader_directory() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  std::string tried;
  for (const fs::path& place : {fs::path(TANGENT_SHADER_DIR), program / "shaders", program / "../shaders",
                                program / "../share/tangent/shaders"}) {
    if (fs::exists(place / "facets.vert.glsl", ignored)) return place;
    tried += (tried.empty() ? "" : ", ") + place.string();
  }
  return fail("the shaders are missing", tried, "keep the directory 'shaders' beside the program");
}

ShaderProgram::ShaderProgram(ShaderProgram&& other) noexcept { *this = std::move(other); }

ShaderProgram& ShaderProgram::operator=(ShaderProgram&& other) noexcept {
  std::swap(directory_, other.directory_);
  std::swap(name_, other.name_);
  std::swap(id_, other.id_);
  std::swap(sources_, other.sources_);
  return *this;
}

ShaderProgram::~ShaderProgram() {
  if (id_ != 0) glDeleteProgram(id_);
}

Result<ShaderProgram> ShaderProgram::load(const fs::path& directory, const std::string& name) {
  Files files;
  const Result<GLuint> id = build(directory, name, files);
  if (!id) return tl::unexpected(id.error());
  ShaderProgram program;
  program.directory_ = directory;
  program.name_ = name;
  program.id_ = *id;
  for (const fs::path& path : files) program.sources_.push_back({path, written(path)});
  return program;
}

Status ShaderProgram::reload_if_changed() {
  bool changed = false;
  for (Source& source : sources_) {
    const auto now = written(source.path);
    changed = changed || now != source.written;
    source.written = now;  // text that fails to compile is not tried again until it changes
  }
  if (!changed) return {};
  Result<ShaderProgram> fresh = load(directory_, name_);
  if (!fresh) return tl::unexpected(fresh.error());
  *this = std::move(*fresh);
  return {};
}

void ShaderProgram::use() const { glUseProgram(id_); }

void ShaderProgram::set(const char* name, int value) const { glUniform1i(glGetUniformLocation(id_, name), value); }
void ShaderProgram::set(const char* name, float value) const { glUniform1f(glGetUniformLocation(id_, name), value); }
void ShaderProgram::set(const char* name, const glm::vec2& value) const {
  glUniform2fv(glGetUniformLocation(id_, name), 1, glm::value_ptr(value));
}
void ShaderProgram::set(const char* name, const glm::vec3& value) const {
  glUniform3fv(glGetUniformLocation(id_, name), 1, glm::value_ptr(value));
}
void ShaderProgram::set(const char* name, const glm::vec4& value) const {
  glUniform4fv(glGetUniformLocation(id_, name), 1, glm::value_ptr(value));
}
void ShaderProgram::set(const char* name, const glm::mat3& value) const {
  glUniformMatrix3fv(glGetUniformLocation(id_, name), 1, GL_FALSE, glm::value_ptr(value));
}
void ShaderProgram::set(const char* name, const glm::mat4& value) const {
  glUniformMatrix4fv(glGetUniformLocation(id_, name), 1, GL_FALSE, glm::value_ptr(value));
}

}  // namespace tangent
