// Runs a file of commands (commands.h), one a line, in the window: what a person would do, by text. Blank lines and
// those that begin with # are skipped. A line is run when what the one before it began is done: a mesh is loaded, a
// widget pressed, a picture written.
#pragma once

#include "core/base/result.h"
#include "workbench/gui/panels/panels.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tangent {

class ScriptRunner {
 public:
  /// Replaces a script that has ended. Fails when the file can't be read, or while another runs.
  Status load(const std::filesystem::path& file);
  /// The same of lines that are in no file.
  Status load_lines(const std::string& name, const std::string& lines);
  bool running() const { return next_ < lines_.size() || waiting_; }

  /// Call once per frame, before it is built. Fails where a line does: file and line number, what, what to do; the
  /// script has then ended. What the window says on account of a line, an error or that it did not do it, counts as its
  /// own; so does a button that is greyed.
  Status step(AppModel& model, MenuBar& menu, ItemMap& items);

 private:
  bool busy(AppModel& model, MenuBar& menu, const ItemMap& items);
  Status ended(Error error);
  /// Runs the next line that is a command.
  Status run_next(AppModel& model, MenuBar& menu);

  std::filesystem::path file_;
  std::vector<std::string> lines_;
  std::size_t next_ = 0;
  bool waiting_ = false;          ///< for what the line before began
  int settling_ = 0;              ///< frames
  std::uint64_t errors_ = 0;      ///< said before the line
  std::uint64_t refusals_ = 0;    ///< the same
  std::uint64_t until_tick_ = 0;  ///< of a servo that runs by itself
};

}  // namespace tangent
