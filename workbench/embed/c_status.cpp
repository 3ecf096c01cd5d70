// The C interface: versions, and what a status says by itself.
#include "workbench/embed/c_handle.h"

#include <string>

static_assert(TANGENT_C_VERSION == TANGENT_PROJECT_VERSION, "tangent_c.h has not the version of CMakeLists.txt");

namespace tangent::c {
namespace {

std::string version_text(uint32_t version) {
  return std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
         std::to_string(version % 100);
}

}  // namespace

bool version_fits(uint32_t version) { return version / 100 == TANGENT_C_VERSION / 100; }

Error version_error(uint32_t version) {
  const std::string ours = version_text(TANGENT_C_VERSION);
  return {"the program was compiled for tangent " + version_text(version) + ", and this library is " + ours,
          "libtangent_c",
          "compile it with tangent_c.h of " + ours + ", or install the library that it was compiled for"};
}

Error size_error(const char* name, std::size_t given, std::size_t ours) {
  return {std::string("size is ") + std::to_string(given) + " bytes, and here the struct has " + std::to_string(ours),
          name,
          "set size to sizeof(" + std::string(name) + "), and compile with the tangent_c.h that came with the library"};
}

}  // namespace tangent::c

const char* tangent_status_text(tangent_status status) {
  switch (status) {
    case TANGENT_OK:
      return "done";
    case TANGENT_FAILED:
      return "a file, a value or an option is wrong; the error text of the handle says which";
    case TANGENT_NULL:
      return "a handle or pointer is null; check that the call that makes the handle returned TANGENT_OK";
    case TANGENT_BAD_SIZE:
      return "a struct's size is not the library's; set size to sizeof the struct, and compile with the tangent_c.h "
             "that came with the library";
    case TANGENT_BAD_VERSION:
      return "program and library are of different versions; compile with the tangent_c.h that came with the library";
    case TANGENT_BAD_POSE:
      return "a pose can't be used; times, positions, orientations and velocities have to be finite, orientations unit";
    case TANGENT_BUSY:
      return "another thread is using this stepper; make one stepper per thread, the scene is shared";
    case TANGENT_CANCELLED:
      return "tangent_cancel ended it; call again to go on from there, or tangent_reset to begin anew";
    case TANGENT_NO_MEMORY:
      return "there is not enough memory; use a smaller mesh or batch";
  }
  return "not a status of this library";
}

uint32_t tangent_library_version(void) { return TANGENT_C_VERSION; }
