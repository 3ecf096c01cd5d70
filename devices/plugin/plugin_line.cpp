#include "devices/plugin/plugin_line.h"

namespace tangent {

const char* to_string(PluginVerdict verdict) {
  switch (verdict) {
    case PluginVerdict::none:
      return "";
    case PluginVerdict::failed:
      return "the plug-in's exchange failed";
    case PluginVerdict::allocated:
      return "the plug-in's exchange allocated memory";
    case PluginVerdict::hung:
      return "the plug-in's exchange did not return in time, and its device was told to stop";
    case PluginVerdict::silent:
      return "no command came in time, and the plug-in's device was told to stop";
    case PluginVerdict::stopped:
      return "the plug-in's device was told to stop";
  }
  return "the plug-in's process said something unknown";
}

const char* remedy(PluginVerdict verdict) {
  switch (verdict) {
    case PluginVerdict::none:
      return "";
    case PluginVerdict::failed:
      return "see to what it says, then arm again";
    case PluginVerdict::allocated:
      return "allocate in open instead (malloc, new, printf and strings do), then arm again";
    case PluginVerdict::hung:
      return "exchange must not wait: read in a thread of the plug-in's own; then arm again";
    case PluginVerdict::silent:
    case PluginVerdict::stopped:
      return "arm again";
  }
  return "use the workbench-plugin of this workbench";
}

}  // namespace tangent
