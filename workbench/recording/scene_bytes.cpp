#include "workbench/recording/scene_bytes.h"

#include "core/planar/curve.h"
#include "workbench/recording/byte_stream.h"

namespace tangent {
namespace {

enum class SceneKind : std::uint8_t { mesh = 1, polygon = 2, exact_arc = 3 };

template <class Stream>
void describe(Stream& stream, PolygonMesh& mesh) {
  stream.all(mesh.positions, mesh.normals, mesh.face_offsets, mesh.corner_position, mesh.corner_normal);
}

template <class Stream>
void describe(Stream& stream, ContactMeshOptions& options) {
  auto fitted = static_cast<std::uint8_t>(options.fit_m.has_value());
  double fit_m = options.fit_m.value_or(0.0);
  auto turn_over = static_cast<std::uint8_t>(options.turn_over);
  stream.all(fitted, fit_m, options.normals, options.crease_rad, turn_over);
  options.fit_m = fitted != 0 ? std::optional(fit_m) : std::nullopt;
  options.turn_over = turn_over != 0;
}

template <class Stream>
void describe(Stream& stream, ExactArc& arc) {
  stream.all(arc.centre, arc.radius_m, arc.half_angle_rad, arc.run_out_m);
}

/// Faces must lie one after the other within their corners, and each corner has a normal or none has.
bool is_whole(const PolygonMesh& mesh) {
  if (mesh.face_offsets.empty() || mesh.face_offsets.front() != 0 ||
      mesh.face_offsets.back() != mesh.corner_position.size())
    return false;
  for (std::size_t i = 1; i < mesh.face_offsets.size(); ++i)
    if (mesh.face_offsets[i] < mesh.face_offsets[i - 1]) return false;
  return mesh.corner_normal.empty() || mesh.corner_normal.size() == mesh.corner_position.size();
}

}  // namespace

SceneSource source_of_planar(const ContactScene& scene) {
  SceneSource source;
  source.polygon = std::make_shared<const PlanarPolygon>(scene.planar()->polygon());
  return source;
}

std::string scene_hash(const ContactScene& scene) {
  if (scene.planar() == nullptr) return hex_text(scene.mesh().content_hash());
  return hex_text(hash_of(scene_bytes(source_of_planar(scene))));
}

std::vector<unsigned char> scene_bytes(const SceneSource& source) {
  ByteWriter writer;
  if (source.mesh) {
    PolygonMesh mesh = *source.mesh;
    ContactMeshOptions options = source.options;
    writer(SceneKind::mesh);
    describe(writer, options);
    describe(writer, mesh);
  } else {
    std::optional<ExactArc> arc = source.polygon->exact;
    writer.all(arc ? SceneKind::exact_arc : SceneKind::polygon, static_cast<std::uint8_t>(source.polygon->closed));
    writer(source.polygon->vertices);
    if (arc) describe(writer, *arc);
  }
  return writer.take();
}

Result<SceneSource> scene_source_from(std::span<const unsigned char> bytes, const std::string& name) {
  ByteReader reader(bytes);
  SceneKind kind{};
  SceneSource source;
  reader(kind);
  if (kind == SceneKind::mesh) {
    auto mesh = std::make_shared<PolygonMesh>();
    mesh->name = name;
    describe(reader, source.options);
    describe(reader, *mesh);
    if (!reader.done() || !is_whole(*mesh) || source.options.normals > NormalSource::computed)
      return fail("its bytes are no mesh", name);
    source.mesh = std::move(mesh);
  } else {
    auto polygon = std::make_shared<PlanarPolygon>();
    polygon->name = name;
    std::uint8_t closed = 0;
    reader(closed);
    reader(polygon->vertices);
    polygon->closed = closed != 0;
    if (kind == SceneKind::exact_arc) describe(reader, polygon->exact.emplace());
    if ((kind != SceneKind::polygon && kind != SceneKind::exact_arc) || !reader.done())
      return fail("its bytes are neither mesh nor polygon", name);
    source.polygon = std::move(polygon);
  }
  return source;
}

Result<std::shared_ptr<const ContactScene>> build_scene(const SceneSource& source, const SceneParts& parts,
                                                        const RunBoth& run_both) {
  if (source.mesh) {
    Result<ContactMesh> mesh = ContactMesh::build(*source.mesh, source.options, run_both);
    if (!mesh) return tl::unexpected(mesh.error());
    return ContactScene::build(std::move(*mesh), parts, run_both);
  }
  Result<PlanarCurve> curve = PlanarCurve::build(*source.polygon);
  if (!curve) return tl::unexpected(curve.error());
  return ContactScene::build(std::move(*curve), parts);
}

}  // namespace tangent
