// Curves of two recordings on one axis, their difference below.
#pragma once

#include "workbench/gui/widgets/ui_context.h"
#include "workbench/recording/compare_recordings.h"

#include <cstdint>
#include <optional>

namespace tangent {

/// In which a channel of kComparedChannels is shown: shown = SI * scale.
struct ComparedUnit {
  double scale;
  const char* name;
};
ComparedUnit unit_of_compared(std::size_t channel);

struct ComparedPointer {
  const ComparedBin* over = nullptr;     ///< the bin under the pointer; null: none
  std::optional<std::uint64_t> clicked;  ///< tick of the first
};
/// Over the whole width. `chosen`: a tick of the first that is marked.
ComparedPointer draw_compared_curves(const UiContext& ui, const RecordingsCompared& c, std::size_t channel,
                                     std::optional<std::uint64_t> chosen);

}  // namespace tangent
