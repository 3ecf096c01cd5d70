#include "workbench/gui/render/paint_buffers.h"

#include <array>
#include <cmath>

namespace tangent {
namespace {
constexpr unsigned kValuesUnit = 1, kColoursUnit = 2, kKeptUnit = 3;
}

void IndexedBuffer::upload(const void* data, std::size_t bytes, GLenum format) {
  glBindBuffer(GL_TEXTURE_BUFFER, buffer_.create());
  glBufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_DYNAMIC_DRAW);
  glBindTexture(GL_TEXTURE_BUFFER, texture_.create());
  glTexBuffer(GL_TEXTURE_BUFFER, format, buffer_.id());
  glBindBuffer(GL_TEXTURE_BUFFER, 0);
}

void IndexedBuffer::bind(unsigned unit) const {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(GL_TEXTURE_BUFFER, texture_.id());
  glActiveTexture(GL_TEXTURE0);
}

// Binds a buffer to every unit: software rasterisers may fetch in branches not taken.
void PaintBuffers::create() {
  const std::uint32_t nothing = 0;
  values_.upload(&nothing, sizeof nothing, GL_R32F);
  kept_.upload(&nothing, sizeof nothing, GL_R8UI);
  no_sources_.upload(&nothing, sizeof nothing, GL_R32UI);
  upload_colours(ColourMap::tide, false);
}

void PaintBuffers::upload_colours(ColourMap map, bool reversed) {
  std::array<std::uint32_t, kColourMapSize> row{};
  const auto& table = colour_table(map);
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = packed(table[reversed ? row.size() - 1 - i : i]);
  glBindTexture(GL_TEXTURE_2D, colours_.create());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, static_cast<GLsizei>(row.size()), 1, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               row.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void PaintBuffers::take(const std::optional<MapPaint>& map, const std::shared_ptr<const Isolation>& isolation,
                        const ContactMesh& mesh) {
  if (map && uploaded_values_ != map->version) {
    values_.upload(map->values.data(), map->values.size_bytes(), GL_R32F);
    uploaded_values_ = map->version;
  }
  if (map && (!map_ || map_->colours != map->colours || map_->reversed != map->reversed)) {
    upload_colours(map->colours, map->reversed);
  }
  map_ = map;
  isolated_ = isolation != nullptr;
  if (isolated_ && uploaded_mask_ != isolation->version) {
    std::vector<std::uint8_t> of_usable;  // the order in which they are drawn
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
      if (mesh.usable(t)) of_usable.push_back(t < isolation->kept.size() ? isolation->kept[t] : 1);
    }
    kept_.upload(of_usable.data(), of_usable.size(), GL_R8UI);
    uploaded_mask_ = isolation->version;
  }
}

void PaintBuffers::apply(const ShaderProgram& program, bool map, Rgba pending, Rgba none) const {
  const auto rgb = [](Rgba c) { return glm::vec3(c.r, c.g, c.b); };
  const bool on = map && map_.has_value();
  // Samplers of different types must not share a unit, even if unused.
  program.set("map_values", static_cast<int>(kValuesUnit));
  program.set("map_colours", static_cast<int>(kColoursUnit));
  program.set("kept", static_cast<int>(kKeptUnit));
  program.set("sources", static_cast<int>(kSourcesUnit));
  program.set("map_level", on ? static_cast<int>(map_->level) : 0);
  program.set("isolate", isolated_ ? 1 : 0);
  program.set("first_triangle", 0);
  kept_.bind(kKeptUnit);
  values_.bind(kValuesUnit);
  no_sources_.bind(kSourcesUnit);
  glActiveTexture(GL_TEXTURE0 + kColoursUnit);
  glBindTexture(GL_TEXTURE_2D, colours_.id());
  glActiveTexture(GL_TEXTURE0);
  if (!on) return;
  const auto axis = [&](double v) { return static_cast<float>(map_->logarithmic ? std::log(v) : v); };
  program.set("map_range", glm::vec2(axis(map_->low), axis(map_->high)));
  program.set("map_log", map_->logarithmic ? 1 : 0);
  program.set("map_pending_colour", rgb(pending));
  program.set("map_none_colour", rgb(none));
}

}  // namespace tangent
