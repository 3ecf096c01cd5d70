// Which plug-in drives the force device "plugin", and how long it may take for what.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tangent {

struct PluginOptions {
  std::filesystem::path path;                                 ///< of the shared library; empty: none is named
  std::vector<std::pair<std::string, std::string>> settings;  ///< key, value: for the plug-in
  bool in_process = false;                                    ///< within this program: its crash is ours
  std::filesystem::path host;  ///< the program that it runs in; empty: workbench-plugin beside this program

  double wait_s = 100e-6;    ///< an exchange waits no longer for the answer to its own command, then takes the last one
  double watchdog_s = 0.05;  ///< no command for this long: its process stops the device
  double hang_s = 0.01;      ///< an exchange of the plug-in that takes longer: its process stops the device
  double kill_s = 0.5;       ///< no answer for this long: its process is ended and started again
  double open_s = 10.0;      ///< loading and opening take no longer
  double end_s = 1.0;        ///< closing takes no longer; then its process is killed
  double restart_s = 0.5;    ///< from the end of its process to the next; twice that after every failure, 5 s at most
  bool realtime = true;      ///< its process asks for SCHED_FIFO
  double memory_mb = 512.0;  ///< that its process may take beyond what it begins with; 0: no limit
};

}  // namespace tangent
