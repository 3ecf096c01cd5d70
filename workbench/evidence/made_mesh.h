// Generated meshes by the command that makes them, "make octagon --rounding-mm 1.5": a preset that ships names its mesh
// so, and needs no file beside it.
#pragma once

#include "core/lab/objects/generate.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tangent {

struct MadeMesh {
  std::string object;
  GenerateOptions options;
};

/// "make octagon --segments 4 --rounding-mm 1.5 --facing left", what is not the default.
std::string made_text(const MadeMesh& made);
/// Empty: this is no such command.
std::optional<MadeMesh> made_from(std::string_view text);

/// What the first line of a file that `make` wrote says: "make octagon". Empty: it says nothing of the kind.
std::string made_text_of(const std::filesystem::path& file);

}  // namespace tangent
