#include "devices/openhaptics/hd_api.h"

#include "devices/base/vendor_library.h"

#include <cstdlib>

namespace tangent::hd {

namespace {

constexpr const char* kNames[] = {"libHD.so", "libHD.so.3.4", "libHD.so.3"};
constexpr const char* kInstall =
    "install OpenHaptics and the Touch driver (support.3dsystems.com, \"OpenHaptics for Linux\")";
constexpr const char* kUpdate = "install OpenHaptics 3.4 or newer (support.3dsystems.com)";
constexpr long kOldestMajor = 3;

}  // namespace

Result<Api> load(const std::filesystem::path& path) {
  auto library = VendorLibrary::load({.path = path, .names = kNames, .option = "--hd-library", .remedy = kInstall});
  if (!library) return tl::unexpected(library.error());
  Api api{};
  library->bind(api.init_device, "hdInitDevice");
  library->bind(api.disable_device, "hdDisableDevice");
  library->bind(api.begin_frame, "hdBeginFrame");
  library->bind(api.end_frame, "hdEndFrame");
  library->bind(api.enable, "hdEnable");
  library->bind(api.disable, "hdDisable");
  library->bind(api.get_doublev, "hdGetDoublev");
  library->bind(api.get_integerv, "hdGetIntegerv");
  library->bind(api.get_string, "hdGetString");
  library->bind(api.set_doublev, "hdSetDoublev");
  library->bind(api.get_error, "hdGetError");
  library->bind(api.check_calibration, "hdCheckCalibration");
  library->bind(api.update_calibration, "hdUpdateCalibration");
  library->bind(api.schedule_asynchronous, "hdScheduleAsynchronous");
  library->bind(api.unschedule, "hdUnschedule");
  library->bind(api.set_scheduler_rate, "hdSetSchedulerRate");
  library->bind(api.start_scheduler, "hdStartScheduler");
  library->bind(api.stop_scheduler, "hdStopScheduler");
  if (const Status complete = library->complete(kUpdate); !complete) return tl::unexpected(complete.error());
  return api;
}

Status check_version(const char* version) {
  if (version == nullptr) return {};
  char* end = nullptr;
  const long major = std::strtol(version, &end, 10);
  if (end == version || major >= kOldestMajor) return {};
  return fail("its version is " + std::string(version) + ", and 3 or newer is needed", "OpenHaptics", kUpdate);
}

}  // namespace tangent::hd
