#include "workbench/session/kept_memory.h"

#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include <sys/resource.h>

using namespace tangent;

namespace {

// The sanitizers have an allocator of their own.
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr bool kOurs = false;
#else
constexpr bool kOurs = true;
#endif

/// Pages that the system hands out for an array of `bytes`.
long pages_of_array(std::size_t bytes) {
  const auto pages = [] {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_minflt;
  };
  const long before = pages();
  const auto array = std::make_unique_for_overwrite<std::uint8_t[]>(bytes);
  std::memset(array.get(), 1, bytes);
  const volatile std::uint8_t* last = array.get() + bytes - 1;
  CHECK(*last == 1);
  return pages() - before;
}

}  // namespace

TEST_CASE("while memory is kept the next array has the pages of the last one, afterwards new ones" *
          doctest::skip(!kOurs)) {
  constexpr std::size_t kBytes = std::size_t{64} << 20;
  const long fresh = pages_of_array(kBytes);
  {
    const KeptMemory kept;
    pages_of_array(kBytes);
    CHECK(pages_of_array(kBytes) < fresh / 10);
    CHECK(pages_of_array(kBytes / 2) < fresh / 10);
  }
  CHECK(pages_of_array(kBytes) > fresh / 2);
  CHECK(pages_of_array(kBytes) > fresh / 2);
}

TEST_CASE("memory that is taken beforehand is there for the first array, and given back at the end" *
          doctest::skip(!kOurs)) {
  constexpr std::size_t kBytes = std::size_t{64} << 20;
  const long fresh = pages_of_array(kBytes);
  {
    const KeptMemory kept(2 * kBytes);
    CHECK(pages_of_array(kBytes) < fresh / 10);
    CHECK(pages_of_array(2 * kBytes - (4u << 20)) < fresh / 10);
  }
  CHECK(pages_of_array(kBytes) > fresh / 2);
}

TEST_CASE("memory is taken beforehand for large meshes, by the kind of file, and for nothing else") {
  const testing::TempFolder folder;
  const auto file = [&](const char* name, const std::string& begin, std::uintmax_t size) {
    const std::filesystem::path path = folder.path() / name;
    std::ofstream(path, std::ios::binary) << begin;
    std::filesystem::resize_file(path, size);
    return memory_to_open(path);
  };
  constexpr std::uintmax_t kLarge = 10u << 20;
  const std::string binary = "ply\nformat binary_little_endian 1.0\nelement vertex 50000\nelement face ";
  CHECK(file("small.ply", binary + "100000\n", 1000) == 0);
  CHECK(file("binary.ply", binary + "100000\n", kLarge) == 11'400'000);
  CHECK(file("too_many.ply", binary + "1e300\n", kLarge) == 114 * kLarge);  // no more faces than bytes
  CHECK(file("negative.ply", binary + "-5\n", kLarge) == 0);
  const std::size_t text = file("text.ply", "ply\nformat ascii 1.0\n", kLarge);
  CHECK(text > kLarge);
  CHECK(text < 2 * kLarge);
  CHECK(file("mesh.obj", "v 0 0 0\n", kLarge) == text);
  CHECK(file("mesh.stl", "", kLarge) == 2 * kLarge);
  CHECK(memory_to_open(folder.path() / "none.obj") == 0);
  CHECK(memory_to_open(folder.path()) == 0);
  CHECK(memory_to_open("/dev/zero") == 0);
}
