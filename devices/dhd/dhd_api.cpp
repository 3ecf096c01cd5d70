#include "devices/dhd/dhd_api.h"

#include "devices/base/vendor_library.h"

#include <string>

namespace tangent::dhd {

namespace {

constexpr const char* kLibraryNames[] = {"libdhd.so", "libdrd.so", "libdhd.so.3", "libdrd.so.3"};
constexpr const char* kGetSdk = "install Force Dimension's SDK (forcedimension.com/software/sdk)";
constexpr const char* kNewSdk = "install Force Dimension's SDK 3.7 or newer (forcedimension.com/software/sdk)";
constexpr int kOldestMinorOf3 = 3;  // set_force came with 3.3

}  // namespace

Result<Api> load(const std::filesystem::path& path) {
  auto library =
      VendorLibrary::load({.path = path, .names = kLibraryNames, .option = "--dhd-library", .remedy = kGetSdk});
  if (!library) return tl::unexpected(library.error());
  Api api{};
  library->bind(api.get_sdk_version, "dhdGetSDKVersion");
  library->bind(api.get_device_count, "dhdGetDeviceCount");
  library->bind(api.open_id, "dhdOpenID");
  library->bind(api.open_serial, "dhdOpenSerial");
  library->bind(api.close, "dhdClose");
  library->bind(api.stop, "dhdStop");
  library->bind(api.error_get_last, "dhdErrorGetLast");
  library->bind(api.get_serial_number, "dhdGetSerialNumber");
  library->bind(api.get_system_type, "dhdGetSystemType");
  library->bind(api.get_system_name, "dhdGetSystemName");
  library->bind(api.has_wrist, "dhdHasWrist");
  library->bind(api.get_status, "dhdGetStatus");
  library->bind(api.enable_force, "dhdEnableForce");
  library->bind(api.get_position, "dhdGetPosition");
  library->bind(api.get_linear_velocity, "dhdGetLinearVelocity");
  library->bind(api.get_orientation_frame, "dhdGetOrientationFrame");
  library->bind(api.get_button_mask, "dhdGetButtonMask");
  library->bind(api.set_force, "dhdSetForceAndTorqueAndGripperForce");
  library->bind_if_there(api.get_watchdog, "dhdGetWatchdog");
  if (const Status complete = library->complete(kNewSdk); !complete) return tl::unexpected(complete.error());
  int major = 0, minor = 0, release = 0, revision = 0;
  api.get_sdk_version(&major, &minor, &release, &revision);
  if (major > 3 || (major == 3 && minor >= kOldestMinorOf3)) return api;
  return fail("its version is " + std::to_string(major) + "." + std::to_string(minor) + ", and 3.3 or newer is needed",
              library->name(), kNewSdk);
}

}  // namespace tangent::dhd
