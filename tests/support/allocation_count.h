// Counts every allocation of this program and its libraries per thread, at malloc itself. Included by one source of a
// program, and not with a sanitizer, which has its own malloc.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdlib>

namespace tangent::testing {

constinit inline thread_local std::size_t allocations = 0;  ///< of this thread, so far

}  // namespace tangent::testing

// glibc's own functions under the names it keeps for those who put themselves in front of them.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) {
  ++tangent::testing::allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++tangent::testing::allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  ++tangent::testing::allocations;
  return __libc_realloc(memory, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  ++tangent::testing::allocations;
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++tangent::testing::allocations;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  ++tangent::testing::allocations;
  *memory = __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}
}
