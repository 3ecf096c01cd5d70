#include "workbench/recording/state_bytes.h"

#include "workbench/recording/byte_stream.h"

#include <algorithm>

namespace tangent {
namespace {

template <class Stream>
void describe(Stream& stream, SurfacePlace& place) {
  stream.all(place.feature, place.side, place.triangle, place.u, place.v);
}

template <class Stream>
void describe(Stream& stream, TrackedPlane& plane) {
  describe(stream, static_cast<SurfacePlace&>(plane));
  stream.all(plane.point, plane.normal, plane.turn);
}

/// Bit fields have no address.
template <class Stream>
void describe(Stream& stream, WatchedTriangle& watched) {
  std::uint32_t packed =
      watched.triangle | std::uint32_t{watched.part} << 28 | std::uint32_t{watched.holds_rival} << 31;
  stream.all(packed, watched.margin_m);
  watched.triangle = packed & ((1u << 28) - 1u);
  watched.part = (packed >> 28) & 7u;
  watched.holds_rival = (packed & (1u << 31)) != 0;
}

template <class Stream>
void describe(Stream& stream, Clearance& c) {
  stream.all(c.centre, c.orientation, c.free_m, c.margin_m, c.height_m, c.ahead_centre, c.ahead_m, c.ahead_height_m);
  auto count = static_cast<std::uint16_t>(c.watched_count);
  auto flags = static_cast<std::uint16_t>(c.any_turn | c.under_way << 1);
  stream.all(count, flags, c.ahead);
  c.watched_count = std::min<std::uint16_t>(count, Clearance::kWatched);
  c.any_turn = (flags & 1u) != 0;
  c.under_way = (flags & 2u) != 0;
  for (WatchedTriangle& watched : c.on_watch()) describe(stream, watched);
  if (c.under_way) stream.all(c.next.part, c.next.node);
}

template <class Stream>
void describe(Stream& stream, RenderedState& r) {
  stream.all(r.force_n, r.cld_m, r.force_rule, r.display_rule, r.velocity, r.display_waits_s, r.has, r.changes,
             r.force_fades, r.display_fades, r.change_s, r.stiffness_n_per_m);
}

template <class Stream>
void describe(Stream& stream, TickState& s) {
  describe(stream, s.plane);
  stream.all(s.last_converged.point, s.last_converged.normal, s.last_converged_s, s.last_position, s.last_orientation,
             s.last_t_s, s.has_previous, s.has_converged, s.has_proxy, s.unentered, s.start, s.late_m, s.lost_m);
  describe(stream, s.clearance);
  stream.all(s.proxy, s.touched.count);
  s.touched.count = std::min<std::uint32_t>(s.touched.count, kMostTouched);
  for (std::uint32_t i = 0; i < s.touched.count; ++i) describe(stream, s.touched.places[i]);
  describe(stream, s.rendered);
}

/// Whether the scene has such a place.
bool can_be(const SurfacePlace& place, const ContactScene& scene) {
  if (place.feature > Feature::vertex || place.side > 2) return false;
  if (place.triangle == kNone) return place.feature == Feature::none;
  if (const PlanarCurve* curve = scene.planar()) return place.triangle < curve->patch_count();
  return place.triangle < scene.mesh().triangle_count() && scene.mesh().usable(place.triangle);
}

bool can_be(const TickState& state, const ContactScene& scene) {
  bool possible = can_be(state.plane, scene) && state.start <= Start::in_vain;
  for (std::uint32_t i = 0; i < state.touched.count; ++i) possible = possible && can_be(state.touched.places[i], scene);
  for (const WatchedTriangle& watched : state.clearance.on_watch()) {
    if (scene.planar() != nullptr) return possible;
    possible = possible && watched.triangle < scene.mesh().triangle_count() && scene.mesh().usable(watched.triangle);
  }
  return possible;
}

}  // namespace

std::vector<unsigned char> state_bytes(const TickState& state) {
  ByteWriter writer;
  TickState copy = state;
  describe(writer, copy);
  return writer.take();
}

Result<TickState> state_from(std::span<const unsigned char> bytes, const ContactScene& scene) {
  ByteReader reader(bytes);
  TickState state;
  describe(reader, state);
  if (!reader.done()) return fail("a kept state has " + std::to_string(bytes.size()) + " bytes, which is not its size");
  if (!can_be(state, scene)) return fail("a kept state names a place that the scene does not have");
  return state;
}

bool state_was_touched(const ServoRecord& now, const ServoRecord* before) {
  if (before == nullptr) return true;
  const TickState& kept = now.tick.kept;
  return now.tick.preset_id != before->tick.preset_id || now.scene_id != before->scene_id ||
         now.tick.tick != before->tick.tick + 1 || (kept.rendered.changes != 0 && kept.rendered.change_s == 0.0) ||
         kept.has_previous == 0 || !same_bits(kept.last_t_s, before->tick.input.t_s);
}

}  // namespace tangent
