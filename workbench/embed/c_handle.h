// What all handles of the C interface share: the text of the last error, and that nothing is thrown across.
#pragma once

#include "core/base/float_state.h"
#include "core/base/result.h"
#include "core/mesh/polygon_mesh.h"
#include "core/preset/preset.h"
#include "core/tick/step.h"
#include "workbench/embed/tangent_c.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <memory>
#include <new>
#include <string_view>

namespace tangent::c {

/// The text of a handle's last error. Of fixed size: an error in a tick allocates nothing.
class ErrorText {
 public:
  const char* get() const { return text_.data(); }
  void clear() { text_[0] = '\0'; }
  void set(std::string_view text) {
    const std::size_t length = std::min(text.size(), text_.size() - 1);
    std::memcpy(text_.data(), text.data(), length);
    text_[length] = '\0';
  }
  void set(const Error& error) { set(error.message()); }

 private:
  std::array<char, 1024> text_{};
};

/// Keeps an error's text and is its status.
template <class Handle>
tangent_status fail_with(Handle& handle, const Error& error, tangent_status status = TANGENT_FAILED) {
  handle.error.set(error);
  return status;
}

/// Runs `work`, which returns a status, as the library was tested (float_state.h), and turns what it throws into one.
template <class Handle, class Work>
tangent_status run_guarded(Handle& handle, Work work) noexcept {
  const FloatState as_tested;
  handle.error.clear();
  try {
    return work();
  } catch (const std::bad_alloc&) {
    handle.error.set("there is not enough memory; use a smaller mesh or batch");
    return TANGENT_NO_MEMORY;
  } catch (const std::exception& exception) {
    handle.error.set(exception.what());
  } catch (...) {
    handle.error.set("an unknown exception");
  }
  return TANGENT_FAILED;
}

/// Whether a program that was compiled for `version` can use this library: 0.x fits where x does.
bool version_fits(uint32_t version);
Error version_error(uint32_t version);
Error size_error(const char* name, std::size_t given, std::size_t ours);

/// Makes a handle, also where `work(handle)` fails, for its error text; refuses other versions.
template <class Handle, class Work>
tangent_status make_handle(uint32_t version, Handle** out, Work work) noexcept {
  if (out == nullptr) return TANGENT_NULL;
  *out = new (std::nothrow) Handle;
  if (*out == nullptr) return TANGENT_NO_MEMORY;
  Handle& handle = **out;
  return run_guarded(handle, [&] {
    if (!version_fits(version)) return fail_with(handle, version_error(version), TANGENT_BAD_VERSION);
    return work(handle);
  });
}

inline void copy_vector(const Vec3& from, double (&to)[3]) {
  for (int k = 0; k < 3; ++k) to[k] = from[k];
}

/// Of a struct that the caller gave: its size is ours.
template <class Struct, class Handle>
tangent_status check_size(Handle& handle, const Struct& given, const char* name) {
  if (given.size == sizeof(Struct)) return TANGENT_OK;
  return fail_with(handle, size_error(name, given.size, sizeof(Struct)), TANGENT_BAD_SIZE);
}

}  // namespace tangent::c

// NOLINTBEGIN(readability-identifier-naming): of tangent_c.h
struct tangent_scene {
  tangent::c::ErrorText error;
  std::shared_ptr<const tangent::ContactScene> scene;  ///< null: it could not be made
  std::shared_ptr<const tangent::PolygonMesh> source;  ///< as the file holds it; null: a 2D scene
};

struct tangent_preset {
  tangent::c::ErrorText error;
  bool usable = false;  ///< it was read
  tangent::Preset preset;
};

struct tangent_stepper {
  tangent::c::ErrorText error;
  std::atomic<bool> in_use{false};
  std::atomic<bool> cancelled{false};
  std::unique_ptr<tangent::Stepper> stepper;  ///< null: it could not be made
  tangent::TickState state;
  uint64_t tick = 0;
};
// NOLINTEND(readability-identifier-naming)
