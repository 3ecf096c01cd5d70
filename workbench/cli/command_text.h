// A command line as it was typed, for files that say how they were made.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace tangent {

/// "workbench tune ball.obj --out p.toml", with every option by its long name; words quoted where a shell needs it.
std::string command_text(const std::string& name, const CLI::App& command);

}  // namespace tangent
