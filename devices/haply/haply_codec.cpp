#include "devices/haply/haply_codec.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace tangent {

namespace {

using HaplyJson = nlohmann::json;

/// A message made to exhaust the stack, or the memory, is refused before it is parsed.
bool too_deep(std::string_view text) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\')
      ++i;
    else if (c == '"')
      quoted = !quoted;
    else if (!quoted && (c == '{' || c == '['))
      ++depth;
    else if (!quoted && (c == '}' || c == ']'))
      --depth;
    if (depth > kHaplyDeepest) return true;
  }
  return false;
}

/// Null where the key is missing.
const HaplyJson* at(const HaplyJson& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

bool read_number(const HaplyJson& object, const char* key, double& out) {
  const HaplyJson* value = at(object, key);
  if (value == nullptr || !value->is_number()) return false;
  out = value->get<double>();
  return std::isfinite(out);
}

bool read_vector(const HaplyJson& object, Vec3& out) {
  return read_number(object, "x", out.x) && read_number(object, "y", out.y) && read_number(object, "z", out.z);
}

/// A missing one stays as it was; one that is neither true nor false is an error.
bool read_flag(const HaplyJson& object, const char* key, bool& out) {
  const HaplyJson* value = at(object, key);
  if (value == nullptr) return true;
  if (!value->is_boolean()) return false;
  out = value->get<bool>();
  return true;
}

bool read_status(const HaplyJson& entry, HaplyStatus& out) {
  const HaplyJson* status = at(entry, "status");
  if (status == nullptr) return true;
  return status->is_object() && read_flag(*status, "calibrated", out.calibrated) &&
         read_flag(*status, "ready", out.ready) && read_flag(*status, "started", out.started) &&
         read_flag(*status, "power_supply", out.power) && read_flag(*status, "in_use", out.in_use);
}

bool is_vector(const HaplyJson* object, const char* key, double each) {
  const HaplyJson* value = object == nullptr ? nullptr : at(*object, key);
  Vec3 v{0.0};
  return value == nullptr || (read_vector(*value, v) && v == Vec3(each));
}

bool changes_nothing(const HaplyJson* pose) {
  const HaplyJson* rotation = pose == nullptr ? nullptr : at(*pose, "rotation");
  double w = 0.0;
  return is_vector(pose, "position", 0.0) && is_vector(pose, "scale", 1.0) && is_vector(pose, "rotation", 0.0) &&
         (rotation == nullptr || (read_number(*rotation, "w", w) && std::abs(w) == 1.0));
}

bool has_own_axes(const HaplyJson& entry) {
  const HaplyJson *config = at(entry, "config"), *state = at(entry, "state");
  const HaplyJson* basis = config == nullptr ? nullptr : at(*config, "basis");
  const HaplyJson* permutation = basis == nullptr ? nullptr : at(*basis, "permutation");
  return (permutation == nullptr || *permutation == "XYZ") &&
         changes_nothing(config == nullptr ? nullptr : at(*config, "mount")) &&
         changes_nothing(state == nullptr ? nullptr : at(*state, "transform"));
}

HaplyProblem read_state(const HaplyJson& entry, HaplyEntry& out) {
  if (!read_status(entry, out.status)) return HaplyProblem::not_understood;
  if (at(entry, "config") != nullptr) out.own_axes = true;  // said anew, and whole
  out.own_axes = out.own_axes && has_own_axes(entry);
  const HaplyJson* state = at(entry, "state");
  const HaplyJson* position = state == nullptr ? nullptr : at(*state, "cursor_position");
  if (position == nullptr || !read_vector(*position, out.position_m)) return HaplyProblem::not_understood;
  if (glm::length(out.position_m) > kHaplyFarthest_m) return HaplyProblem::position;
  const HaplyJson* velocity = at(*state, "cursor_velocity");
  if (velocity == nullptr) return HaplyProblem::none;
  if (!read_vector(*velocity, out.velocity_m_per_s)) return HaplyProblem::not_understood;
  out.has_velocity = true;
  return glm::length(out.velocity_m_per_s) > kHaplyFastest_m_per_s ? HaplyProblem::position : HaplyProblem::none;
}

bool read_device(const HaplyJson& entry, const std::vector<HaplyEntry>& before, HaplyEntry& out) {
  const HaplyJson* id = at(entry, "device_id");
  if (id == nullptr || !id->is_string() || !is_haply_id(id->get_ref<const std::string&>())) return false;
  out.id = id->get<std::string>();
  for (const HaplyEntry& known : before) {
    if (known.id == out.id) out.status = known.status, out.own_axes = known.own_axes;
  }
  out.problem = read_state(entry, out);
  return true;
}

bool read_buttons(const HaplyJson& state, std::uint32_t& out) {
  bool pressed = false;
  if (!read_flag(state, "button", pressed)) return false;
  out = pressed ? 1u : 0u;
  const HaplyJson* buttons = at(state, "buttons");
  for (unsigned i = 0; buttons != nullptr && i < 3; ++i) {
    const char name[2] = {static_cast<char>('a' + i), '\0'};
    pressed = false;
    if (!read_flag(*buttons, name, pressed)) return false;
    out |= pressed ? 1u << i : 0u;
  }
  return true;
}

/// A grip that is asleep may say anything, and nobody may need it: that it lies is noted, the message is good.
void read_turn(const HaplyJson& state, HaplyGrip& out) {
  constexpr double kUnit = 0.02;  // of its square; the published examples are within 0.0001
  const HaplyJson* said = at(state, "orientation");
  if (said == nullptr) return;
  Quat q(1.0, 0.0, 0.0, 0.0);
  const bool numbers = read_number(*said, "w", q.w) && read_number(*said, "x", q.x) && read_number(*said, "y", q.y) &&
                       read_number(*said, "z", q.z);
  const double square = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  out.lies = !numbers || !(std::abs(square - 1.0) < kUnit);
  out.turned = !out.lies;
  if (out.turned) out.orientation = q * (1.0 / std::sqrt(square));
}

bool read_grips(const HaplyJson& root, HaplyMessage& out) {
  for (const char* kind : {"verse_grip", "wireless_verse_grip"}) {
    const HaplyJson* list = at(root, kind);
    if (list == nullptr) continue;
    if (!list->is_array()) return false;
    for (const HaplyJson& grip : *list) {
      ++out.grips;
      const HaplyJson* state = at(grip, "state");
      if (state == nullptr) continue;
      if (!read_buttons(*state, out.grip.buttons)) return false;
      read_turn(*state, out.grip);
    }
  }
  if (out.grips > 1) out.grip = {};
  return true;
}

bool read_root(const HaplyJson& root, const std::vector<HaplyEntry>& before, HaplyMessage& out) {
  if (!root.is_object()) return false;
  out.has_session = at(root, "session_id") != nullptr;
  const HaplyJson* list = at(root, "inverse3");
  if (list != nullptr && (!list->is_array() || list->size() > kHaplyMostDevices)) return false;
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    if (!read_device((*list)[i], before, out.devices.emplace_back())) return false;
  }
  return read_grips(root, out);
}

/// A text of the service's that is shown to people: no control characters, nothing endless.
std::string shown(const std::string& text) {
  constexpr std::size_t kLongest = 200;
  std::string out = text.substr(0, kLongest);
  for (char& c : out)
    if (c < ' ' || c > '~') c = '?';
  return out;
}

const std::string* text_at(const HaplyJson& object, const char* key) {
  const HaplyJson* value = at(object, key);
  return value == nullptr || !value->is_string() ? nullptr : &value->get_ref<const std::string&>();
}

bool read_level(const std::string& name, HaplyEvent::Level& out) {
  constexpr std::array kLevels{"info", "notice", "warning", "error", "critical", "panic"};
  const auto* const found = std::find(kLevels.begin(), kLevels.end(), name);
  if (found == kLevels.end()) return false;
  out = static_cast<HaplyEvent::Level>(found - kLevels.begin());
  return true;
}

void append_number(std::string& out, const char* key, double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, 6);
  out.append(key).append(digits.data(), end.ptr);
}

}  // namespace

bool is_haply_id(std::string_view id) {
  const auto plain = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' || c == '_' ||
           c == '.';
  };
  return !id.empty() && id.size() <= 64 && std::all_of(id.begin(), id.end(), plain);
}

bool read_haply(std::string_view text, const std::vector<HaplyEntry>& before, HaplyMessage& out) {
  out = {};
  if (text.size() > kHaplyLargestMessage || too_deep(text)) return false;
  const HaplyJson root = HaplyJson::parse(text.begin(), text.end(), nullptr, false);
  return !root.is_discarded() && read_root(root, before, out);
}

bool read_haply_event(std::string_view text, HaplyEvent& out) {
  out = {};
  if (text.size() > kHaplyLargestMessage || too_deep(text)) return false;
  const HaplyJson root = HaplyJson::parse(text.begin(), text.end(), nullptr, false);
  const std::string *name = text_at(root, "name"), *level = text_at(root, "level"), *said = text_at(root, "message");
  if (name == nullptr || level == nullptr || !read_level(*level, out.level)) return false;
  if (const HaplyJson* data = at(root, "data"); data != nullptr) {
    if (const std::string* id = text_at(*data, "device_id"); id != nullptr && is_haply_id(*id)) out.device = *id;
  }
  out.text = shown(said == nullptr || said->empty() ? *name : *name + ": " + *said);
  return true;
}

void write_haply_force(std::string& out, std::string_view id, const Vec3& force_n, bool vector) {
  out.assign(R"({"inverse3":[{"device_id":")").append(id);
  out.append(R"(","commands":{"set_cursor_force":{")").append(vector ? "vector" : "values").append("\":{");
  append_number(out, "\"x\":", force_n.x);
  append_number(out, ",\"y\":", force_n.y);
  append_number(out, ",\"z\":", force_n.z);
  out.append("}}}}]}");
}

}  // namespace tangent
