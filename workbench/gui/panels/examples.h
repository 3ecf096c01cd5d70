// Scenes worth a first look, one a job: each is a script (commands.h) that a person could type.
#pragma once

#include <span>

namespace tangent {

struct Example {
  const char* name;
  const char* tip;
  const char* lines;
};
std::span<const Example> examples();

}  // namespace tangent
