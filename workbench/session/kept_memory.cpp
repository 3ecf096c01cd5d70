#include "workbench/session/kept_memory.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

namespace tangent {
namespace {

/// All pages of a block, in one call instead of one by one. A system that can't leaves them to be taken as ever.
void take_pages(void* block, std::size_t bytes) {
  constexpr std::uintptr_t kLargePage = 2u << 20;
  const auto first = reinterpret_cast<std::uintptr_t>(block);
  const std::uintptr_t begin = (first + kLargePage - 1) & ~(kLargePage - 1), end = (first + bytes) & ~(kLargePage - 1);
  if (begin >= end) return;
  auto* const at = reinterpret_cast<void*>(begin);  // NOLINT(performance-no-int-to-ptr): a page of the block
  ::madvise(at, end - begin, MADV_HUGEPAGE);
#ifdef MADV_POPULATE_WRITE
  ::madvise(at, end - begin, MADV_POPULATE_WRITE);
#endif
}

std::size_t free_memory() {
  const long pages = ::sysconf(_SC_AVPHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
  return pages > 0 && page > 0 ? static_cast<std::size_t>(pages) * static_cast<std::size_t>(page) : 0;
}

}  // namespace

// Blocks of their own, as large ones have by default, go back to the system when they are freed.
KeptMemory::KeptMemory(std::size_t beforehand) {
  constexpr int kNoBlocks = 0, kNever = -1;
  ::mallopt(M_MMAP_MAX, kNoBlocks);
  ::mallopt(M_TRIM_THRESHOLD, kNever);
  beforehand = std::min(beforehand, free_memory() / 2);
  if (beforehand == 0) return;
  void* const block = std::malloc(beforehand);
  if (!block) return;
  take_pages(block, beforehand);
  std::free(block);  // and is kept
}

// As the C library begins, with the largest thresholds that it would come to by itself.
KeptMemory::~KeptMemory() {
  constexpr int kManyBlocks = 65536, kLargest = 32 << 20;
  ::mallopt(M_MMAP_MAX, kManyBlocks);
  ::mallopt(M_MMAP_THRESHOLD, kLargest);
  ::mallopt(M_TRIM_THRESHOLD, 2 * kLargest);
  ::malloc_trim(0);
}

// Somewhat less than the peak is, so that nothing is taken in vain.
std::size_t memory_to_open(const std::filesystem::path& mesh) {
  constexpr std::uintmax_t kSmall = 8u << 20;
  constexpr double kPerFace = 114.0, kOfStl = 2.0, kOfText = 1.5;  // bytes; parts of the file's size
  std::error_code failed;
  const std::uintmax_t size = std::filesystem::file_size(mesh, failed);
  if (failed || size < kSmall || !std::filesystem::is_regular_file(mesh, failed)) return 0;
  std::string header(2048, ' ');
  std::ifstream(mesh, std::ios::binary).read(header.data(), static_cast<std::streamsize>(header.size()));
  const std::string faces = "element face ";
  if (const std::size_t at = header.find(faces);
      header.starts_with("ply") && header.find("format binary") != std::string::npos && at != std::string::npos) {
    const double count = std::strtod(header.c_str() + at + faces.size(), nullptr);
    return static_cast<std::size_t>(kPerFace * std::clamp(count, 0.0, static_cast<double>(size)));
  }
  const bool is_stl = mesh.extension() == ".stl" || mesh.extension() == ".STL";
  return static_cast<std::size_t>(static_cast<double>(size) * (is_stl ? kOfStl : kOfText));
}

}  // namespace tangent
