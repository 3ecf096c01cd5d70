#include "workbench/gui/render/scene_buffers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace tangent {
namespace {

template <class T>
void fill_array_buffer(GlBuffer& buffer, std::span<const T> data, GLenum usage) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer.create());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(data.size_bytes()), data.data(), usage);
}

}  // namespace

void FacetBuffer::clear() {
  count_ = 0;
  waiting_ = {};
}

void FacetBuffer::begin_upload(std::vector<FacetVertex> vertices) {
  waiting_ = std::move(vertices);
  uploaded_ = 0;
  count_ = 0;
  glBindVertexArray(array_.create());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.create());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(waiting_.size() * sizeof(FacetVertex)), nullptr,
               GL_STATIC_DRAW);
  vertex_attribute(0, 3, GL_FLOAT, false, sizeof(FacetVertex), offsetof(FacetVertex, position));
  vertex_attribute(1, 4, GL_INT_2_10_10_10_REV, true, sizeof(FacetVertex), offsetof(FacetVertex, face_normal));
  glBindVertexArray(0);
}

bool FacetBuffer::continue_upload(std::size_t bytes) {
  if (waiting_.empty()) return true;
  const std::size_t all = waiting_.size() * sizeof(FacetVertex), n = std::min(bytes, all - uploaded_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.id());
  glBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(uploaded_), static_cast<GLsizeiptr>(n),
                  reinterpret_cast<const std::byte*>(waiting_.data()) + uploaded_);
  uploaded_ += n;
  if (uploaded_ < all) return false;
  count_ = static_cast<GLsizei>(waiting_.size());
  waiting_ = {};
  return true;
}

void FacetBuffer::draw(std::size_t first_triangle, std::size_t triangles) const {
  if (count_ == 0) return;
  glBindVertexArray(array_.id());
  glDrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * first_triangle), static_cast<GLsizei>(3 * triangles));
}

void SurfaceBuffer::clear() {
  mesh_ = {};
  ready_ = false;
  count_ = 0;
}

void SurfaceBuffer::begin_upload(SurfaceMesh mesh) {
  mesh_ = std::move(mesh);
  uploaded_ = 0;
  ready_ = false;
  level_ = mesh_.level;
  glBindVertexArray(array_.create());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.create());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh_.vertices.size() * sizeof(SurfaceVertex)), nullptr,
               GL_STATIC_DRAW);
  vertex_attribute(0, 3, GL_FLOAT, false, sizeof(SurfaceVertex), offsetof(SurfaceVertex, position));
  vertex_attribute(1, 4, GL_INT_2_10_10_10_REV, true, sizeof(SurfaceVertex), offsetof(SurfaceVertex, normal));
  vertex_attribute(2, 2, GL_UNSIGNED_BYTE, true, sizeof(SurfaceVertex), offsetof(SurfaceVertex, weights));
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.create());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh_.indices.size() * sizeof(std::uint32_t)), nullptr,
               GL_STATIC_DRAW);
  glBindVertexArray(0);
}

bool SurfaceBuffer::continue_upload(std::size_t bytes) {
  if (ready_ || mesh_.indices.empty()) return ready_;
  const std::size_t vertex_bytes = mesh_.vertices.size() * sizeof(SurfaceVertex);
  const std::size_t index_bytes = mesh_.indices.size() * sizeof(std::uint32_t);
  const auto copy = [&](GLenum target, const void* data, std::size_t from, std::size_t size) {
    const std::size_t n = std::min(bytes, size - from);
    glBufferSubData(target, static_cast<GLintptr>(from), static_cast<GLsizeiptr>(n),
                    static_cast<const std::byte*>(data) + from);
    bytes -= n;
    uploaded_ += n;
  };
  glBindVertexArray(array_.id());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.id());
  if (uploaded_ < vertex_bytes) copy(GL_ARRAY_BUFFER, mesh_.vertices.data(), uploaded_, vertex_bytes);
  if (uploaded_ >= vertex_bytes && bytes > 0) {
    copy(GL_ELEMENT_ARRAY_BUFFER, mesh_.indices.data(), uploaded_ - vertex_bytes, index_bytes);
  }
  glBindVertexArray(0);
  if (uploaded_ < vertex_bytes + index_bytes) return false;
  count_ = static_cast<GLsizei>(mesh_.indices.size());
  mesh_ = {};
  ready_ = true;
  return true;
}

void SurfaceBuffer::draw(std::size_t first_triangle, std::size_t triangles) const {
  if (!ready_) return;
  glBindVertexArray(array_.id());
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * triangles), GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(3 * first_triangle * sizeof(std::uint32_t)));
}

void StrokeBuffer::upload(std::span<const Stroke> strokes, GLenum usage) {
  glBindVertexArray(array_.create());
  fill_array_buffer(instances_, strokes, usage);
  vertex_attribute(0, 3, GL_FLOAT, false, sizeof(Stroke), offsetof(Stroke, a));
  vertex_attribute(1, 3, GL_FLOAT, false, sizeof(Stroke), offsetof(Stroke, b));
  vertex_attribute(2, 4, GL_UNSIGNED_BYTE, true, sizeof(Stroke), offsetof(Stroke, colour));
  vertex_attribute(3, 1, GL_FLOAT, false, sizeof(Stroke), offsetof(Stroke, width_px));
  for (GLuint i = 0; i < 4; ++i) glVertexAttribDivisor(i, 1);
  glBindVertexArray(0);
  count_ = static_cast<GLsizei>(strokes.size());
}

void StrokeBuffer::draw() const {
  if (count_ == 0) return;
  glBindVertexArray(array_.id());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count_);
}

void FillBuffer::upload(std::span<const FillVertex> vertices) {
  glBindVertexArray(array_.create());
  fill_array_buffer(vertices_, vertices, GL_STREAM_DRAW);
  vertex_attribute(0, 3, GL_FLOAT, false, sizeof(FillVertex), offsetof(FillVertex, position));
  vertex_attribute(1, 4, GL_UNSIGNED_BYTE, true, sizeof(FillVertex), offsetof(FillVertex, colour));
  glBindVertexArray(0);
  count_ = static_cast<GLsizei>(vertices.size());
}

void FillBuffer::draw() const {
  if (count_ == 0) return;
  glBindVertexArray(array_.id());
  glDrawArrays(GL_TRIANGLES, 0, count_);
}

namespace {

struct SolidVertex {
  std::array<float, 4> direction_half;
  std::array<float, 3> normal;
};

constexpr int kAround = 48, kRings = 24;  // rings from pole to pole; even, so that a capsule splits at the equator

// Point of a unit body of revolution about x.
SolidVertex around_x(double x, double radius, double angle, double half, double normal_x, double normal_r) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto f = [](double value) { return static_cast<float>(value); };
  return {{f(x), f(radius * c), f(radius * s), f(half)}, {f(normal_x), f(normal_r * c), f(normal_r * s)}};
}

void append_band(std::vector<SolidVertex>& out, auto&& lower, auto&& upper) {
  for (int i = 0; i < kAround; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kAround, b = 2.0 * std::numbers::pi * (i + 1) / kAround;
    out.insert(out.end(), {lower(a), lower(b), upper(b), lower(a), upper(b), upper(a)});
  }
}

void append_ball(std::vector<SolidVertex>& out) {
  const auto at = [](int ring, double half) {
    const double polar = std::numbers::pi * ring / kRings - 0.5 * std::numbers::pi;
    const double x = std::sin(polar), r = std::cos(polar);
    return [=](double angle) { return around_x(x, r, angle, half, x, r); };
  };
  for (int ring = 0; ring < kRings; ++ring) {
    const double half = ring < kRings / 2 ? -1.0 : 1.0;
    append_band(out, at(ring, half), at(ring + 1, half));
    if (ring + 1 == kRings / 2) append_band(out, at(ring + 1, -1.0), at(ring + 1, 1.0));  // a capsule's wall
  }
}

void append_cap(std::vector<SolidVertex>& out, double half) {
  append_band(
      out, [=](double a) { return around_x(0.0, 1.0, a, half, half, 0.0); },
      [=](double a) { return around_x(0.0, 0.0, a, half, half, 0.0); });
}

}  // namespace

void SolidBuffer::create() {
  std::vector<SolidVertex> vertices;
  const auto close = [&](SolidShape shape, std::size_t first) {
    ranges_[static_cast<std::size_t>(shape)] = {static_cast<GLint>(first),
                                                static_cast<GLsizei>(vertices.size() - first)};
  };
  append_ball(vertices);
  close(SolidShape::ball, 0);
  std::size_t first = vertices.size();
  append_band(
      vertices, [](double a) { return around_x(0.0, 1.0, a, -1.0, 0.0, 1.0); },
      [](double a) { return around_x(0.0, 1.0, a, 1.0, 0.0, 1.0); });
  append_cap(vertices, -1.0);
  close(SolidShape::cylinder, first);
  first = vertices.size();
  append_band(
      vertices, [](double a) { return around_x(0.0, 1.0, a, -1.0, 1.0, 1.0); },
      [](double a) { return around_x(0.0, 0.0, a, 1.0, 1.0, 1.0); });
  append_cap(vertices, -1.0);
  close(SolidShape::cone, first);
  glBindVertexArray(array_.create());
  fill_array_buffer(vertices_, std::span<const SolidVertex>(vertices), GL_STATIC_DRAW);
  vertex_attribute(0, 4, GL_FLOAT, false, sizeof(SolidVertex), offsetof(SolidVertex, direction_half));
  vertex_attribute(1, 3, GL_FLOAT, false, sizeof(SolidVertex), offsetof(SolidVertex, normal));
  glBindVertexArray(0);
}

void SolidBuffer::draw(SolidShape shape) const {
  const Range& range = ranges_[static_cast<std::size_t>(shape)];
  glBindVertexArray(array_.id());
  glDrawArrays(GL_TRIANGLES, range.first, range.count);
}

}  // namespace tangent
