#include "workbench/session/kept_devices.h"

#include "workbench/session/falcon_setups.h"

#include <utility>

namespace tangent {

Result<DeviceSet> make_devices_as_kept(const DeviceNames& names, DeviceOptions options) {
  if (names.force == "falcon") {
    auto falcon = chosen_falcon_options(options.falcon, falcon_setups_path());
    if (!falcon) return tl::unexpected(falcon.error());
    options.falcon = std::move(*falcon);
  }
  return make_devices(names, options);
}

}  // namespace tangent
