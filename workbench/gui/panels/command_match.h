// The rows of the command palette, and which of them a typed text means.
#pragma once

#include "workbench/gui/panels/commands.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

struct PaletteRow {
  std::string title = {};  ///< "Map: Curvature"
  std::string line = {};   ///< that runs it: "map curvature"
  std::string keys = {};
  std::string words = {};                   ///< further words by which it is found
  std::string value = {};                   ///< of the argument now, or what it takes; empty: neither
  bool complete = true;                     ///< false: the line needs a value yet
  ArgumentKind takes = ArgumentKind::none;  ///< a value that may follow the line
};

/// One for every command, and one for every choice of those that have choices.
std::vector<PaletteRow> palette_rows(std::span<const Command> commands);

/// Rows that the text means, best first; all of them for an empty text. Every word of it must be in the row: as a word
/// of its title or of its synonyms, as the beginning or a part of one, or as one with a slip of a letter; or it is the
/// value that the row takes, and then part of its line.
std::vector<PaletteRow> matching_rows(const std::vector<PaletteRow>& rows, std::string_view typed);

/// 0 to 1: how well `typed` (words, without a value) fits; 0: not at all.
double match_score(std::string_view title, std::string_view words, std::string_view typed);

}  // namespace tangent
