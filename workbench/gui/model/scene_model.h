// The mesh or polygon being explored: its source, import options and audit. Opened in a worker thread, unless the
// window is deterministic.
#pragma once

#include "workbench/gui/model/app_options.h"
#include "workbench/gui/model/message_log.h"
#include "workbench/gui/model/preset_model.h"
#include "workbench/gui/model/scene_loader.h"
#include "workbench/recording/scene_bytes.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace tangent {

/// Event: the current scene was replaced.
struct SceneChange {
  PreparedScenePtr prepared;  ///< for the servo; null: it keeps its own
  bool opened = false;        ///< false: the same mesh, rebuilt with another option
};

class SceneModel {
 public:
  /// `changed` is called when current() was replaced.
  SceneModel(const AppOptions& options, const PresetModel& presets, MessageLog& messages,
             std::function<void(SceneChange)> changed);

  void open_first(const std::string& mesh);  ///< empty, or when it can't be opened: the built-in scene
  void open(const std::string& mesh);        ///< a file or a generated object
  /// One that comes from a recording, with the options it was read with; it has no file to read again.
  void show(LoadedScene loaded, const ContactMeshOptions& options);
  /// Another scene comes into view, that of a recorded tick; the servo keeps its own (of_servo()). `source`: what it
  /// was built from; null: unknown, or it is the servo's.
  void look_at(const std::shared_ptr<const ContactScene>& scene, const SceneSource* source);
  /// The scene that was opened last. Null: none yet.
  const std::shared_ptr<const ContactScene>& of_servo() const { return own_ ? own_->scene : shown_.scene; }
  void update();  ///< takes in the workers' results

  /// Null until the first one is loaded.
  const std::shared_ptr<const ContactScene>& current() const { return shown_.scene; }
  const PolygonMesh* polygons() const { return shown_.polygons.get(); }
  const std::string& path() const { return shown_.path; }
  /// What of_servo() was built from. Precondition: there is one.
  SceneSource source() const;
  bool loading() const { return loader_.busy(); }
  const std::string& loading_name() const { return loader_.name(); }
  double load_seconds() const { return shown_.load_seconds; }

  // Null until the audit is done.
  const MeshAudit* audit() const { return report_ ? &report_->audit : nullptr; }
  const PerceptionAudit* perception() const { return report_ ? &report_->perception : nullptr; }
  const MeshFindings* findings() const { return report_ ? &report_->findings : nullptr; }
  bool auditing() const { return loader_.auditing(); }

  // Import options; a change reads or builds the mesh again.
  double metres_per_unit() const { return metres_per_unit_; }
  void set_unit(double metres_per_unit);
  std::optional<double> fit_m() const { return mesh_options_.fit_m; }
  void set_fit(std::optional<double> fit_m);  ///< longest side, m; empty: as in the file
  const ContactMeshOptions& mesh_options() const { return mesh_options_; }
  double crease_angle_rad() const { return mesh_options_.crease_rad; }
  void set_crease_angle(double rad);  ///< keeps the view

 private:
  void load(std::shared_ptr<const PolygonMesh> polygons);
  void take(LoadedScene loaded);
  void changed(PreparedScenePtr prepared, bool opened);
  void warn_of_left_out();
  void warn_of_size();

  const PresetModel& presets_;
  MessageLog& messages_;
  std::function<void(SceneChange)> changed_;
  const bool deterministic_;
  double metres_per_unit_;
  ContactMeshOptions mesh_options_;
  SceneLoader loader_;
  std::string opening_path_;
  struct Shown {
    std::string path;
    std::shared_ptr<const ContactScene> scene;
    std::shared_ptr<const PolygonMesh> polygons;
    ContactMeshOptions built_with, import;  ///< import: of the next mesh that is opened, while this is not in view
    double load_seconds = 0.0;
  };
  Shown shown_;
  std::optional<Shown> own_;  ///< the servo's, while another is in view
  std::optional<MeshReport> report_;
};

}  // namespace tangent
