// Messages of Haply's Inverse Service, as its pages document them (docs.haply.co/inverseSDK, 3.1 to 3.5: "WebSocket
// Protocol", "Simulation Channel", "Control Commands"): the service lists its devices when a client connects, then
// answers every message with one state of all devices. Metres, newtons, and Haply's axes: x right, y away from the
// person, z up, from the base (its pages "Basis Permutation", "Developing with Inverse3").
//
// Allocates; the link's thread only.
#pragma once

#include "core/base/vec.h"
#include "devices/haply/haply_problem.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

/// What the service says of an Inverse3. A message that leaves a value out leaves it as it was.
struct HaplyStatus {
  bool calibrated = false, ready = false, started = false, power = false, in_use = false;
  bool usable() const { return ready && started && power; }
};

struct HaplyEntry {
  std::string id;
  HaplyStatus status;
  Vec3 position_m{0.0}, velocity_m_per_s{0.0};
  bool has_velocity = false;
  bool own_axes = true;                       ///< basis, mount and transform, where it says them, change nothing
  HaplyProblem problem = HaplyProblem::none;  ///< of what is said of this one: not_understood or position
};

/// The only VerseGrip, wired or not; several: which one is in the hand? Then none.
struct HaplyGrip {
  bool turned = false, lies = false;     ///< it says how it is turned; what it says is no rotation
  Quat orientation{1.0, 0.0, 0.0, 0.0};  ///< unit; grip's axes -> Haply's. Its y is where it points
  std::uint32_t buttons = 0;             ///< bit per button
};

struct HaplyMessage {
  bool has_session = false;         ///< a session_id, as the first message of 3.5 has
  std::vector<HaplyEntry> devices;  ///< every Inverse3
  std::size_t grips = 0;            ///< listed
  HaplyGrip grip;                   ///< where there is one
};

/// What the service reports by itself, over the events' port (its pages "Events & Monitoring").
struct HaplyEvent {
  enum class Level : std::uint8_t { info, notice, warning, error, critical, panic };
  Level level = Level::info;
  std::string device;  ///< id of the one that it is about; empty: of none
  std::string text;    ///< "device-safety-triggered: FOD stage changed"; printable ASCII, 200 characters at most
};

inline constexpr std::size_t kHaplyLargestMessage = 256 * 1024;
inline constexpr std::size_t kHaplyMostDevices = 32;
inline constexpr int kHaplyDeepest = 16;         ///< brackets within brackets; a documented message has 6
inline constexpr double kHaplyFarthest_m = 0.6;  ///< from the base; an assumption, beyond the arm
inline constexpr double kHaplyFastest_m_per_s = 20.0;

/// `before`: statuses by device, as the last message left them; may be empty. False on what is not as documented; what
/// is wrong with one device alone is its own `problem`. Does not throw.
bool read_haply(std::string_view text, const std::vector<HaplyEntry>& before, HaplyMessage& out);

/// False on what is not as documented, a level that is not known included. Does not throw.
bool read_haply_event(std::string_view text, HaplyEvent& out);

/// An id that can be written into a message as it is: letters, digits, - _ . and 64 at most.
bool is_haply_id(std::string_view id);

/// set_cursor_force for one device. `vector`: the key of 3.5; else that of 3.1, `values`.
void write_haply_force(std::string& out, std::string_view id, const Vec3& force_n, bool vector);
/// Asks for the list of devices.
inline constexpr std::string_view kHaplyAskList = R"({"session":{"force_render_full_state":{}}})";

}  // namespace tangent
