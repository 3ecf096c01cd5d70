// Where the values of a saved preset come from: the mesh, the devices, and what was measured with them in the window.
#pragma once

#include "core/io/preset_file.h"
#include "core/mesh/contact_mesh.h"
#include "workbench/session/history.h"

#include <cstdint>
#include <string>

namespace tangent {

struct PresetOrigin {
  const ContactMesh* mesh = nullptr;  ///< null: a 2D scene
  double metres_per_unit = 0.0;       ///< of the mesh's file
  std::string devices;
  const History* history = nullptr;  ///< null: nothing was recorded
  std::uint32_t preset_id = 0;       ///< of the preset in the history's records
  std::string note;                  ///< a person's own
};

/// The [about] table: all of the origin, today's date, the program's version, and of the newest ticks under that preset
/// which touched the surface: how many, mean and most planes, how many did not converge, largest error.
PresetAbout about_of(const PresetOrigin& origin);

/// How the mesh differs from the one the preset was saved on, as a sentence; empty: it doesn't, or nothing is said.
std::string other_mesh_text(const PresetAbout& about, const ContactMesh& mesh);

}  // namespace tangent
