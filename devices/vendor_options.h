// What a person says about force devices that are driven through their maker's library.
#pragma once

#include <filesystem>
#include <string>

namespace tangent {

/// 3D Systems Touch and PHANToM, through OpenHaptics.
struct HdOptions {
  std::filesystem::path library;  ///< empty: libHD.so, where the loader finds it
  std::string device;             ///< its name in the maker's setup program; empty: the only one, or the default one
  bool reset_encoders = false;  ///< it lies at its reset position, every link at a right angle to the next, at opening
  std::filesystem::path
      configs;                ///< folder of the driver's setups, a file a device; empty: where the driver keeps them
  double silence_s = 0.1;     ///< its scheduler calls no more for this long: it is stopped, and looked for again
  double reopen_s = 1.0;      ///< how often a lost device is looked for
  double last_frame_s = 0.2;  ///< how long closing waits for the scheduler to send zero force
};

/// Force Dimension delta, omega, sigma and lambda, through their SDK.
struct DhdOptions {
  std::filesystem::path library;  ///< empty: libdhd.so or libdrd.so, where the loader finds them
  int serial = -1;                ///< below 0: the only one
  double peak_n = 0.0;            ///< of the maker's data sheet, for a type that is not known; 0: as known
  double reopen_s = 1.0;          ///< how often a lost device is looked for
};

struct VendorOptions {
  HdOptions hd;
  DhdOptions dhd;
};

}  // namespace tangent
