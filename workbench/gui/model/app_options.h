// Start options of the window.
#pragma once

#include "core/mesh/contact_mesh.h"
#include "devices/device_set.h"
#include "workbench/gui/theme/palette.h"
#include "workbench/session/maestro_setups.h"
#include "workbench/session/session.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace tangent {

struct AppOptions {
  std::string mesh;               ///< a file, or the name of a generated object; empty: the built-in scene
  double metres_per_unit = 1e-3;  ///< of the mesh file (--unit)
  ContactMeshOptions mesh_options;
  std::filesystem::path preset;         ///< empty: the shipped default
  std::filesystem::path preset_folder;  ///< where presets are saved; empty: where `preset` is, or the shipped ones
  DeviceNames devices;
  DeviceOptions drivers;                            ///< of the real force devices
  ArmOnStart arm_on_start = ArmOnStart::simulated;  ///< of the first session; later ones begin without force
  PlaceOptions place;                               ///< of the scene on the force device
  MaestroWish maestro;                              ///< for the display "maestro"
  std::filesystem::path packets;                    ///< file to which USB packets are logged; empty: none
  double servo_hz = 1000.0;                         ///< kSlowestServoHz to kFastestServoHz
  int servo_cpu = -1;                               ///< core for the servo's thread; -1: any
  std::filesystem::path settings;                   ///< file for layout and look between runs; empty: not kept
  std::filesystem::path screenshots;                ///< folder for F12's screenshots; empty: the current one
  double history_s = 600.0;                         ///< length of the history, within kLargestHistoryBytes
  std::size_t solved_bytes = 0;                     ///< that ticks of a recording from A to B may take; 0: half of
                                                    ///< the memory that is free
  std::filesystem::path script;                     ///< commands to run; empty: none
  std::filesystem::path record;                     ///< recording to write; empty: none
  Theme theme = Theme::dark;
  std::uint64_t seed = 1;  ///< of the simulated devices
  /// No servo thread: `advance` steps the session in the caller's thread, in simulated time, so that the same calls
  /// give the same image. For screenshots and tests.
  bool deterministic = false;
};

}  // namespace tangent
