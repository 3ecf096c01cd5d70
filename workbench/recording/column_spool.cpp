#include "workbench/recording/column_spool.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace tangent {
namespace {

/// Some file systems know no unnamed files: there the name is taken away at once.
int open_unnamed(const std::filesystem::path& folder) {
  const int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file >= 0 || (errno != EOPNOTSUPP && errno != EISDIR)) return file;
  std::string name = (folder / ".columns-XXXXXX").string();
  const int named = ::mkostemp(name.data(), O_CLOEXEC);
  if (named >= 0) ::unlink(name.c_str());
  return named;
}

/// All of the bytes, or false with errno; `move` is pread or pwrite.
template <class Move, class Byte>
bool move_all(const Move& move, int file, Byte* bytes, std::size_t size, std::uint64_t at) {
  while (size > 0) {
    const ssize_t moved = move(file, bytes, size, static_cast<off_t>(at));
    if (moved < 0 && errno == EINTR) continue;
    if (moved == 0) errno = EIO;
    if (moved <= 0) return false;
    bytes += moved;
    at += static_cast<std::uint64_t>(moved);
    size -= static_cast<std::size_t>(moved);
  }
  return true;
}

}  // namespace

tl::unexpected<Error> ColumnSpool::system_failure(const char* doing) const {
  const int code = errno;
  return fail(std::string("cannot ") + doing + " a temporary file beside it: " + std::strerror(code), for_.string(),
              "check that the directory is writable and has room for twice what is exported");
}

Result<ColumnSpool> ColumnSpool::create(const std::filesystem::path& folder, std::size_t columns,
                                        const std::filesystem::path& target) {
  ColumnSpool spool(open_unnamed(folder.empty() ? "." : folder), target, columns);
  if (spool.file_ < 0) return spool.system_failure("create");
  return spool;
}

ColumnSpool::ColumnSpool(ColumnSpool&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      for_(std::move(other.for_)),
      columns_(other.columns_),
      rows_(other.rows_),
      block_(std::move(other.block_)) {}

ColumnSpool::~ColumnSpool() {
  if (file_ >= 0) ::close(file_);
}

Status ColumnSpool::add(const std::vector<std::uint64_t>& row) {
  const std::size_t at = rows_ % kBlockRows;
  for (std::size_t i = 0; i < columns_; ++i) block_[i * kBlockRows + at] = row[i];
  ++rows_;
  return at + 1 == kBlockRows ? flush() : Status{};
}

/// The block that the last row is in.
Status ColumnSpool::flush() {
  const std::uint64_t size = block_.size() * sizeof block_[0];
  const std::uint64_t at = (rows_ - 1) / kBlockRows * size;
  if (!move_all(::pwrite, file_, reinterpret_cast<const char*>(block_.data()), size, at))
    return system_failure("write");
  return {};
}

Status ColumnSpool::read(std::size_t column, std::vector<std::uint64_t>& values) {
  if (rows_ % kBlockRows != 0)
    if (Status ok = flush(); !ok) return ok;
  values.resize(rows_);
  for (std::uint64_t first = 0; first < rows_; first += kBlockRows) {
    const std::uint64_t count = std::min<std::uint64_t>(kBlockRows, rows_ - first);
    const std::uint64_t at = (first * columns_ + column * kBlockRows) * sizeof values[0];
    auto* const to = reinterpret_cast<char*>(values.data() + first);
    if (!move_all(::pread, file_, to, count * sizeof values[0], at)) return system_failure("read");
  }
  return {};
}

}  // namespace tangent
