// `workbench` has no graphics: the window and the pictures are a second program beside it, `workbench-window`.
#pragma once

#include <optional>

namespace tangent {

/// Becomes that program where the arguments ask for `gui`, `shot` or `experiment --window`, and, where it is there, for
/// `report`, which it adds pictures to, and without any. Returns none where the arguments are for this program, and an
/// exit code where the other is missing or can't be started; standard error then says which file was looked for.
std::optional<int> hand_over_to_window(int argc, char** argv);

}  // namespace tangent
