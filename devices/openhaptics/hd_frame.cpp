#include "devices/openhaptics/hd_frame.h"

#include <algorithm>
#include <cmath>

namespace tangent::hd {

namespace {

// x right -> -y, y up -> z, z to the person -> -x of the world.
const Quat kToWorld(0.5, 0.5, -0.5, -0.5);
constexpr double kMm = 1e-3;
constexpr double kPerMm = 1e3;
constexpr double kRate_hz = 1000.0;  // that of HD_DEFAULT_SCHEDULER and of the examples of the guide

Vec3 corner(const Corners& box, std::size_t first) { return Vec3(box[first], box[first + 1], box[first + 2]); }

bool is_box(const Corners& box) {
  const bool finite = std::all_of(box.begin(), box.end(), [](double v) { return std::isfinite(v); });
  return finite && box[0] < box[3] && box[1] < box[4] && box[2] < box[5];
}

/// 0 where the library can't say, or says nonsense.
double number(const Api& api, Enum what) {
  double value = 0.0;
  api.get_doublev(what, &value);
  return api.get_error().code == 0 && std::isfinite(value) && value > 0.0 ? value : 0.0;
}

int whole(const Api& api, Enum what) {
  int value = 0;
  api.get_integerv(what, &value);
  return api.get_error().code == 0 ? value : 0;
}

std::string text(const Api& api, Enum what) {
  const char* said = api.get_string(what);
  return api.get_error().code == 0 && said != nullptr ? said : "";
}

}  // namespace

DeviceFrame device_frame() { return {.rotation = kToWorld}; }

Vec3 centre_m(const Corners& box_mm) {
  return is_box(box_mm) ? 0.5 * kMm * (corner(box_mm, 0) + corner(box_mm, 3)) : Vec3(0.0);
}

Vec3 half_size_m(const Corners& box_mm) {
  return is_box(box_mm) ? 0.5 * kMm * (corner(box_mm, 3) - corner(box_mm, 0)) : Vec3(0.0);
}

Vec3 position_m(const double mm[3], const Vec3& centre_m) { return kMm * Vec3(mm[0], mm[1], mm[2]) - centre_m; }

Vec3 velocity_m_per_s(const double mm_per_s[3]) { return kMm * Vec3(mm_per_s[0], mm_per_s[1], mm_per_s[2]); }

Quat orientation(const double transform[16]) {
  Mat3 stylus_to_device(0.0);
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) stylus_to_device[column][row] = transform[4 * column + row];
  return glm::normalize(glm::quat_cast(stylus_to_device) * glm::conjugate(kToWorld));
}

bool is_rotation(const double transform[16]) noexcept {
  constexpr double kWithin = 1e-2;
  const Vec3 x(transform[0], transform[1], transform[2]), y(transform[4], transform[5], transform[6]),
      z(transform[8], transform[9], transform[10]);
  const Vec3 lengths(glm::dot(x, x), glm::dot(y, y), glm::dot(glm::cross(x, y), z));
  const Vec3 angles(glm::dot(x, y), glm::dot(y, z), glm::dot(z, x));
  for (int i = 0; i < 3; ++i)
    if (!(std::abs(lengths[i] - 1.0) < kWithin && std::abs(angles[i]) < kWithin)) return false;
  return true;
}

ForceCapabilities read_capabilities(const Api& api) {
  ForceCapabilities can;
  const std::string model = text(api, kModel);
  can.name = model.empty() ? "OpenHaptics device" : model;
  can.serial = text(api, kSerial);
  can.frame = device_frame();
  can.rate_hz = kRate_hz;
  can.homing_s = 0.0;
  can.peak_force_n = number(api, kMaxForce);
  can.continuous_force_n = std::min(number(api, kMaxContinuousForce), can.peak_force_n);
  can.largest_stiffness_n_per_m = kPerMm * number(api, kMaxStiffness);
  Corners usable{};
  api.get_doublev(kUsableWorkspace, usable.data());
  if (api.get_error().code == 0) can.workspace_half_size_m = half_size_m(usable);
  if (whole(api, kInputDof) >= 6) can.senses_rotation = {true, true, true};
  const bool stylus = model.find("Touch") != std::string::npos || model.find("Omni") != std::string::npos;
  can.buttons = stylus ? 2 : 0;  // the interface does not say how many
  return can;
}

}  // namespace tangent::hd
