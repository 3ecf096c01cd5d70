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
  PreparedScenePtr prepared;  ///< for the servo
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
  void update();  ///< takes in the workers' results

  /// Null until the first one is loaded.
  const std::shared_ptr<const ContactScene>& current() const { return scene_; }
  const PolygonMesh* polygons() const { return polygons_.get(); }
  const std::string& path() const { return path_; }
  /// What current() was built from. Precondition: there is one.
  SceneSource source() const;
  bool loading() const { return loader_.busy(); }
  const std::string& loading_name() const { return loader_.name(); }
  double load_seconds() const { return load_seconds_; }

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
  void warn_of_left_out();
  void warn_of_size();

  const PresetModel& presets_;
  MessageLog& messages_;
  std::function<void(SceneChange)> changed_;
  const bool deterministic_;
  double metres_per_unit_;
  ContactMeshOptions mesh_options_;
  ContactMeshOptions built_with_;  ///< of scene_
  SceneLoader loader_;
  std::string path_, opening_path_;
  std::shared_ptr<const ContactScene> scene_;
  std::shared_ptr<const PolygonMesh> polygons_;
  std::optional<MeshReport> report_;
  double load_seconds_ = 0.0;
};

}  // namespace tangent
