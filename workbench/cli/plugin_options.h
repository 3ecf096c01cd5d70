// Options of the force device "plugin".
#pragma once

#include "devices/plugin/plugin_options.h"

namespace CLI {
class App;
}

namespace tangent {

/// --plugin, --plugin-in-process, --plugin-setting. `plugin` must outlive the parsing.
void add_plugin_options(CLI::App& command, PluginOptions& plugin);

}  // namespace tangent
