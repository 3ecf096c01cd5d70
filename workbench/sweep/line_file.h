// Lines in a file that is only ever appended to, before each 16 hex digits: a checksum of it. No database, and a lock
// only where it is asked for, so it works on a network disk; a process that is killed leaves at most one torn line,
// which the next one removes.
#pragma once

#include "core/io/appended_file.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace tangent::sweep {

/// Of a line without its end: the text after its checksum; empty: it is torn or damaged.
std::optional<std::string_view> checked_text(std::string_view line);

struct LineFileRules {
  std::string damaged = {};  ///< what to do about a damaged line: nothing goes on from it
  AppendRules append = {};
};

class LineFile {
 public:
  /// Takes the text of a whole line, which is the file's `number`th, from 1; may refuse it.
  using Take = std::function<Status(std::string_view text, std::uint64_t number)>;

  /// Makes the file, or goes on with it: `take` gets its lines, and a torn last one is cut off. Fails on a line that is
  /// damaged before the end, naming it.
  static Result<LineFile> open(const std::filesystem::path& path, const Take& take, const LineFileRules& rules);

  /// A single write of a whole line. Where it fails nothing of it stays. Precondition: no line end in it.
  Status add(std::string_view text);
  /// On the disk: a power cut takes nothing of it.
  Status flush() { return file_.flush(); }
  /// The failure that says so of a line.
  static Status damaged(const std::filesystem::path& path, std::uint64_t number, const LineFileRules& rules);

 private:
  explicit LineFile(AppendedFile file) : file_(std::move(file)) {}
  AppendedFile file_;
};

}  // namespace tangent::sweep
