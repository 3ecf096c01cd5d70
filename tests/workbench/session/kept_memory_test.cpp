#include "workbench/session/kept_memory.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <memory>

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
