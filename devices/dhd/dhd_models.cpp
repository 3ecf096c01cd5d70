#include "devices/dhd/dhd_models.h"

#include <array>
#include <cmath>

namespace tangent::dhd {

namespace {

// x to the person -> -x, y right -> -y, z up -> z of the world: half a turn about z.
const Quat kHalfTurn(0.0, 0.0, 0.0, 1.0);

constexpr Model kUnknownModel{0, "Force Dimension device", 0.0, 0.0, 0.0};
constexpr std::array kModels{
    Model{31, "delta.3", 20.0, 5000.0, 0.15},         // DHD_DEVICE_3DOF
    Model{63, "delta.3", 20.0, 5000.0, 0.15},         // DHD_DEVICE_DELTA3
    Model{64, "delta.6", 20.0, 5000.0, 0.15},         // DHD_DEVICE_DELTA6
    Model{32, "omega.3", 12.0, 5000.0, 0.075},        // DHD_DEVICE_OMEGA
    Model{33, "omega.3", 12.0, 5000.0, 0.075},        // DHD_DEVICE_OMEGA3
    Model{34, "omega.6", 12.0, 5000.0, 0.075},        // DHD_DEVICE_OMEGA33
    Model{36, "omega.6 left", 12.0, 5000.0, 0.075},   // DHD_DEVICE_OMEGA33_LEFT
    Model{35, "omega.7", 12.0, 5000.0, 0.075},        // DHD_DEVICE_OMEGA331
    Model{37, "omega.7 left", 12.0, 5000.0, 0.075},   // DHD_DEVICE_OMEGA331_LEFT
    Model{60, "Novint Falcon", 8.0, 3000.0, 0.04},    // DHD_DEVICE_FALCON
    Model{104, "sigma.7", 12.0, 4000.0, 0.075},       // DHD_DEVICE_SIGMA331
    Model{105, "sigma.7 left", 12.0, 4000.0, 0.075},  // DHD_DEVICE_SIGMA331_LEFT
    Model{106, "sigma.6+", 12.0, 4000.0, 0.09},       // DHD_DEVICE_SIGMA33P
    Model{107, "sigma.6+ left", 12.0, 4000.0, 0.09},  // DHD_DEVICE_SIGMA33P_LEFT
};

}  // namespace

const Model& model_of(int type) noexcept {
  for (const Model& model : kModels)
    if (model.type == type) return model;
  return kUnknownModel;
}

Error peak_not_known(const std::string& device) {
  return {"it gets no force: how much it can push is not known, and its library doesn't say", device,
          "look into its data sheet and give --dhd-peak-n"};
}

DeviceFrame device_frame() { return {.rotation = kHalfTurn}; }

Quat orientation(const double matrix[3][3]) {
  Mat3 handle_to_device(0.0);
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) handle_to_device[column][row] = matrix[row][column];
  return glm::normalize(glm::quat_cast(handle_to_device) * glm::conjugate(kHalfTurn));
}

bool is_rotation(const double matrix[3][3]) noexcept {
  constexpr double kWithin = 1e-2;
  const Vec3 x(matrix[0][0], matrix[0][1], matrix[0][2]), y(matrix[1][0], matrix[1][1], matrix[1][2]),
      z(matrix[2][0], matrix[2][1], matrix[2][2]);
  const Vec3 lengths(glm::dot(x, x), glm::dot(y, y), glm::dot(glm::cross(x, y), z));
  const Vec3 angles(glm::dot(x, y), glm::dot(y, z), glm::dot(z, x));
  for (int i = 0; i < 3; ++i)
    if (!(std::abs(lengths[i] - 1.0) < kWithin && std::abs(angles[i]) < kWithin)) return false;
  return true;
}

}  // namespace tangent::dhd
