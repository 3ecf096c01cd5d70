// The view of the scene: camera, layers drawn, picked and isolated triangles, audit findings shown.
#pragma once

#include "workbench/gui/map/map_view.h"
#include "workbench/gui/model/message_log.h"
#include "workbench/gui/model/scene_model.h"
#include "workbench/gui/render/camera_text.h"
#include "workbench/gui/render/scene_renderer.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace tangent {

/// The part of the mesh being inspected.
struct Inspection {
  std::optional<FindingKind> kind;  ///< the finding shown
  std::size_t index = 0;
  std::vector<std::uint32_t> marked;  ///< its triangles, outlined in the view
};

class ViewModel {
 public:
  ViewModel(const SceneModel& scene, const MapView& map, MessageLog& messages);

  // Read and set by panels.
  SceneToggles toggles;
  Camera camera;
  double framed_distance_m = 0.0;   ///< camera distance when the whole scene was last framed
  std::uint64_t framings = 0;       ///< number of framings; the 2D view follows it
  bool follow_contact = false;      ///< the camera goes with the contact
  Vec2 size{0.0};                   ///< of the 3D view, points
  std::array<ViewRoom, 3> rooms{};  ///< parts of the view not covered by cards and bars
  std::uint32_t picked_triangle = kNone;
  std::uint32_t hovered_triangle = kNone;
  bool device_monitor = false;  ///< shown in place of the 3D view
  RenderQuality quality = RenderQuality::automatic;
  bool net_of_picked = false;
  std::optional<SlicePlane> slice;
  std::shared_ptr<const Isolation> isolation;  ///< null: all triangles are drawn

  void look_at_new_scene();  ///< frames the whole scene, picks nothing
  void frame_scene();        ///< frames the whole mesh, beside cards and bars
  /// Turns the camera to a place on the surface, viewed obliquely, and picks the triangle.
  void look_at_place(const Vec3& point_world, const Vec3& normal, std::uint32_t triangle);
  /// Turns the camera to the contact of a tick, viewed obliquely. No effect without one.
  void look_at_contact(const TickRecord* tick);
  /// Once a frame, with the tick in view: while follow_contact the camera goes with the contact; else a jump in time
  /// brings the contact into view where it is outside or on the far side.
  void see_contact(const TickRecord* tick, bool paused);
  /// To the map's worst place; repeated: to the next worst. Null, with a message: there is none.
  const MapPlace* look_at_worst();
  void look_from_standard(StandardView view);
  void set_y_up(bool y_up);
  void copy_camera();  ///< to the clipboard, as text
  void paste_camera();

  const Inspection& inspection() const { return inspection_; }
  void show_finding(FindingKind kind, std::size_t index);  ///< turns to it and marks its triangles
  void isolate_marked();  ///< the marked triangles, or the picked one, and their neighbours
  void isolate_part();    ///< the connected part that holds one of them
  void show_all();        ///< no isolation, no marks
  /// As they were in a session: triangles drawn alone (none: all are drawn), and those marked. Numbers that the mesh
  /// does not have are passed over.
  void take_up(const std::vector<std::uint32_t>& isolated, const std::vector<std::uint32_t>& marked);

 private:
  std::vector<std::uint32_t> marked_or_picked() const;
  bool in_view(const TickOutput& output) const;
  void isolate(const std::vector<std::uint32_t>& triangles);

  const SceneModel& scene_;
  const MapView& map_;
  MessageLog& messages_;
  Inspection inspection_;
  std::uint64_t isolations_ = 0;  ///< number of isolations so far; identifies each
  std::size_t worst_shown_ = 0;
  std::optional<std::uint64_t> seen_tick_;  ///< by see_contact
  bool seen_paused_ = false;
};

}  // namespace tangent
