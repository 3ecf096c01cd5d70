#include "workbench/cli/plugin_options.h"

#include "workbench/cli/option.h"

namespace tangent {

namespace {

std::pair<std::string, std::string> key_and_value(const std::string& given) {
  const std::size_t equals = given.find('=');
  if (equals == 0 || equals == std::string::npos)
    refuse_option("--plugin-setting", "takes key=value, not \"" + given + "\"");
  return {given.substr(0, equals), given.substr(equals + 1)};
}

}  // namespace

void add_plugin_options(CLI::App& command, PluginOptions& plugin) {
  add_text_option(command, "--plugin", plugin.path,
                  "Shared library of a force device of your own, for --force plugin (devices/plugin/README.md)",
                  "PATH.so");
  add_flag(command, "--plugin-in-process", plugin.in_process,
           "Load it into this program instead of a process of its own: its crash is then this program's");
  add_number_option(command, "--plugin-memory-mb", {.min = 0, .max = 1e6, .unit = "MB"},
                    "Memory that the plug-in's process may take; then it gets none (default 512; 0: no limit)",
                    [&plugin](double v) { plugin.memory_mb = v; });
  add_repeated_option(command, "--plugin-setting",
                      "A setting for the plug-in, which says what it knows; may be repeated", "KEY=VALUE",
                      [&plugin](const std::vector<std::string>& given) {
                        for (const std::string& one : given) plugin.settings.push_back(key_and_value(one));
                      });
}

}  // namespace tangent
