// Lines in a file that is only ever appended to, before each 16 hex digits: a checksum of it. No lock, no database, so
// it works on a network disk; a process that is killed leaves at most one torn line, which the next one removes.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace tangent::sweep {

/// Of a line without its end: the text after its checksum; empty: it is torn or damaged.
std::optional<std::string_view> checked_text(std::string_view line);

/// What to do about a file, for its messages.
struct LineFileRemedies {
  std::string damaged;    ///< nothing goes on from it
  std::string not_whole;  ///< a write failed; what is in it stays
};

class LineFile {
 public:
  /// Takes the text of a whole line, which is the file's `number`th, from 1; may refuse it.
  using Take = std::function<Status(std::string_view text, std::uint64_t number)>;

  /// Makes the file, or goes on with it: `take` gets its lines, and a torn last one is cut off. Fails on a line that is
  /// damaged before the end, naming it.
  static Result<LineFile> open(const std::filesystem::path& path, const Take& take, LineFileRemedies remedies);
  LineFile(LineFile&& other) noexcept;
  LineFile& operator=(LineFile&& other) noexcept;
  ~LineFile();

  /// A single write of a whole line. Where it fails nothing of it stays. Precondition: no line end in it.
  Status add(std::string_view text);
  /// On the disk: a power cut takes nothing of it.
  Status flush();
  /// The failure that says so of a line.
  static Status damaged(const std::filesystem::path& path, std::uint64_t number, const LineFileRemedies& remedies);

 private:
  LineFile() = default;
  Result<std::uint64_t> look_through(const Take& take) const;
  std::filesystem::path path_;
  LineFileRemedies remedies_;
  int file_ = -1;
  std::uint64_t bytes_ = 0;  ///< of whole lines
};

}  // namespace tangent::sweep
