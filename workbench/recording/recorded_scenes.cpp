// The scenes of a recording, built again from the bytes that it keeps.
#include "workbench/recording/byte_stream.h"
#include "workbench/recording/recording.h"
#include "workbench/session/two_threads.h"

#include <algorithm>

namespace tangent {
namespace {

constexpr std::int64_t kMostSceneBytes = std::int64_t{8} << 30;

}  // namespace

Result<std::vector<unsigned char>> Recording::bytes_of(const RecordedScene& scene) {
  const std::string where = " WHERE scene_id=" + std::to_string(scene.id);
  const Result<std::int64_t> size =
      database_.whole_of("SELECT coalesce(sum(length(bytes)), 0) FROM scene_bytes" + where);
  if (!size) return tl::unexpected(size.error());
  if (*size < 0 || *size > kMostSceneBytes) return damaged("has a scene of " + std::to_string(*size) + " bytes");
  Result<Statement> parts = database_.prepare("SELECT bytes FROM scene_bytes" + where + " ORDER BY part");
  if (!parts) return tl::unexpected(parts.error());
  std::vector<unsigned char> bytes;
  for (;;) {
    const Result<bool> row = parts->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) break;
    const auto part = parts->bytes(0);
    bytes.insert(bytes.end(), part.begin(), part.end());
  }
  const Result<std::string> hash =
      database_.text_of("SELECT bytes_hash FROM scenes WHERE id=" + std::to_string(scene.id));
  if (!hash) return tl::unexpected(hash.error());
  if (*hash != hex_text(hash_of(bytes))) return damaged("the bytes of scene " + scene.name + " are not those recorded");
  return bytes;
}

Status Recording::is_scene(const RecordedScene& recorded, const ContactScene& scene) const {
  const std::string hash = scene_hash(scene);
  if (hash == recorded.hash) return {};
  return fail("its hash is " + hash + ", and " + recorded.name + " was recorded with " + recorded.hash, path().string(),
              "give the mesh that was recorded, with the options it was read with");
}

Result<SceneSource> Recording::scene_source(std::uint32_t id) {
  const auto found = std::find_if(scenes_.begin(), scenes_.end(), [id](const auto& s) { return s.id == id; });
  if (found == scenes_.end()) return damaged("has no scene " + std::to_string(id));
  if (!found->has_bytes)
    return fail("was recorded without its mesh (--no-mesh)", path().string(),
                "give the mesh " + found->name + " (hash " + found->hash + ") with --mesh");
  Result<std::vector<unsigned char>> bytes = bytes_of(*found);
  if (!bytes) return tl::unexpected(bytes.error());
  return scene_source_from(*bytes, found->name);
}

Result<std::shared_ptr<const ContactScene>> Recording::scene(std::uint32_t id) {
  const Result<SceneSource> source = scene_source(id);
  if (!source) return tl::unexpected(source.error());
  Result<std::shared_ptr<const ContactScene>> scene = build_scene(*source, {}, run_on_two_threads);
  if (!scene) return scene;
  const auto found = std::find_if(scenes_.begin(), scenes_.end(), [id](const auto& s) { return s.id == id; });
  if (Status same = is_scene(*found, **scene); !same) return tl::unexpected(same.error());
  return scene;
}

}  // namespace tangent
