#include "devices/plugin/host/allocation_watch.h"

#include <cerrno>
#include <cstddef>
#include <cstdlib>

namespace {

thread_local bool counting = false;
thread_local std::uint64_t allocations = 0;

std::atomic<std::atomic<std::uint32_t>*> refusals{nullptr};

void note() noexcept {
  if (counting) ++allocations;
}

[[maybe_unused]] void* got(void* memory, std::size_t bytes) noexcept {
  if (memory != nullptr || bytes == 0) return memory;
  if (std::atomic<std::uint32_t>* here = refusals.load(std::memory_order_acquire); here != nullptr)
    here->fetch_add(1, std::memory_order_relaxed);
  return nullptr;
}

}  // namespace

#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)

// A sanitizer's malloc is in use, and tells who asks.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*, std::size_t),
                                                         void (*on_free)(const volatile void*));
namespace {

[[maybe_unused]] const int installed = __sanitizer_install_malloc_and_free_hooks(
    [](const volatile void*, std::size_t) { note(); }, [](const volatile void*) {});

}  // namespace

#else

// glibc's own functions under the names it keeps for those who put themselves in front of them.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) {
  note();
  return got(__libc_malloc(size), size);
}
void* calloc(std::size_t count, std::size_t size) {
  note();
  return got(__libc_calloc(count, size), count == 0 ? 0 : size);
}
void* realloc(void* memory, std::size_t size) {
  note();
  return got(__libc_realloc(memory, size), size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  note();
  return got(__libc_memalign(alignment, size), size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  note();
  return got(__libc_memalign(alignment, size), size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  note();
  *memory = got(__libc_memalign(alignment, size), size);
  return *memory == nullptr ? ENOMEM : 0;
}
}

#endif

namespace tangent {

void count_allocations() noexcept {
  allocations = 0;
  counting = true;
}

std::uint64_t counted_allocations() noexcept {
  counting = false;
  return allocations;
}

void count_refusals(std::atomic<std::uint32_t>& here) noexcept { refusals.store(&here, std::memory_order_release); }

}  // namespace tangent
