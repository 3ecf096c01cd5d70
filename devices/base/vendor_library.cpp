#include "devices/base/vendor_library.h"

#include <dlfcn.h>

#include <utility>

namespace tangent {

Result<VendorLibrary> VendorLibrary::load(const Wanted& wanted) {
  const std::string given = wanted.path.string();
  const char* const only[] = {given.c_str()};
  std::string why;
  for (const char* name : wanted.path.empty() ? wanted.names : std::span<const char* const>(only)) {
    if (void* handle = dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE); handle != nullptr)
      return VendorLibrary(name, handle);
    const char* said = dlerror();
    if (why.empty()) why = said != nullptr ? said : "no reason given";
  }
  return fail("can't be loaded: " + why, wanted.path.empty() ? wanted.names.front() : given,
              std::string(wanted.remedy) + "; " + wanted.option + " says where it is");
}

Status VendorLibrary::complete(const char* remedy) const {
  return missing_.empty() ? Status{} : fail("lacks " + missing_, name_, remedy);
}

void* VendorLibrary::find(const char* symbol) const { return dlsym(handle_, symbol); }

}  // namespace tangent
