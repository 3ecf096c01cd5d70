#include "devices/haply/haply_problem.h"

namespace tangent {

Error haply_error(HaplyProblem problem, const std::string& where, const std::string& detail) {
  const std::string note = detail.empty() ? "" : " (" + detail + ")";
  constexpr const char* kStart = "start Haply Hub or the Inverse Service, or say where it is by --haply-address";
  switch (problem) {
    case HaplyProblem::none:
      return {"no problem", where, ""};
    case HaplyProblem::not_built_in:
      return {"this program was built without Haply's Inverse3", where,
              "install libboost-dev and nlohmann-json3-dev, and build again"};
    case HaplyProblem::address:
      return {"is no address of an Inverse Service" + note, where, "write it as ws://localhost:10001"};
    case HaplyProblem::other_host:
      return {"is not this machine" + note, where,
              "run the service here, or allow another host by --haply-other-host: a force that comes late over a "
              "network is less safe"};
    case HaplyProblem::no_service:
      return {"no Inverse Service answers there" + note, where, kStart};
    case HaplyProblem::no_websocket:
      return {"what answers there is no Inverse Service" + note, where, kStart};
    case HaplyProblem::closed:
      return {"the Inverse Service ended the connection" + note, where, "it is tried again; see Haply Hub"};
    case HaplyProblem::too_long:
      return {"the Inverse Service sent a message that is too long" + note, where, "see whether it is one, and which"};
    case HaplyProblem::silent:
      return {"the Inverse Service does not answer", where, "start it again in Haply Hub"};
    case HaplyProblem::not_understood:
      return {"the Inverse Service sent what is no state message" + note, where,
              "use version 3.1 to 3.5 of it, on the port of the 3.x format (10001)"};
    case HaplyProblem::unasked:
      return {"the Inverse Service sends states that nobody asked for", where,
              "use version 3.1 to 3.5 of it, on the port of the 3.x format (10001)"};
    case HaplyProblem::grip:
      return {"its VerseGrip no longer says how it is turned", where,
              "press a button of it, or plug it in; to go on without one, open the Inverse3 again"};
    case HaplyProblem::alarm:
      return {"the Inverse Service reports an error" + note, where, "see Haply Hub, then arm again"};
    case HaplyProblem::position:
      return {"the Inverse3 says it is where it can't be" + note, where, "calibrate it, in its inkwell"};
    case HaplyProblem::no_device:
      return {"the Inverse Service lists no Inverse3", where, "plug it in, switch it on, and look at Haply Hub"};
    case HaplyProblem::several:
      return {"the Inverse Service lists several" + note, where, "choose one by --haply-device ID"};
    case HaplyProblem::other_device:
      return {"the Inverse Service lists no Inverse3 of this id" + note, where, "plug it in, or choose another"};
    case HaplyProblem::in_use:
      return {"another program drives the Inverse3", where, "close that program"};
    case HaplyProblem::other_frame:
      return {"the Inverse3 is set to other axes than its own" + note, where,
              "undo basis, mount and transform of it in Haply Hub"};
    case HaplyProblem::not_started:
      return {"the Inverse3 is not started" + note, where, "connect its power supply, and look at Haply Hub"};
    case HaplyProblem::bad_command:
      return {"was sent a force that is not finite", where, "report this"};
    case HaplyProblem::slow:
      return {"the Inverse Service answers too late", where, "close programs that keep this machine busy"};
  }
  return {};
}

DeviceFault fault_of(HaplyProblem problem) noexcept {
  switch (problem) {
    case HaplyProblem::not_understood:
    case HaplyProblem::other_frame:
    case HaplyProblem::unasked:
      return DeviceFault::firmware;
    case HaplyProblem::position:
    case HaplyProblem::grip:
      return DeviceFault::sensor;
    case HaplyProblem::alarm:
    case HaplyProblem::not_started:
    case HaplyProblem::in_use:
      return DeviceFault::actuator;
    case HaplyProblem::silent:
    case HaplyProblem::slow:
      return DeviceFault::disconnected;
    case HaplyProblem::bad_command:
      return DeviceFault::bad_command;
    default:
      return DeviceFault::none;
  }
}

}  // namespace tangent
