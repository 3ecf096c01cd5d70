// Before the first trial: does the device do what the protocol asks for, and what is said of both.
#pragma once

#include "workbench/experiment/stimuli.h"
#include "workbench/session/session.h"

#include <string>
#include <vector>

namespace tangent::experiment {

inline constexpr const char* kNotArmed = "not armed yet; put the finger into the device, and press resume";

/// 16 digits of the library that computes the ticks.
std::string program_digest();

/// One stimulus of each kind that the protocol's presets come from; never empty.
std::vector<Stimulus> kinds_of(const Protocol& protocol);
/// Fails without a force device, and where a condition needs a display that is missing.
Status check_conditions(const Protocol& protocol, const Stimuli& stimuli, const Session& session);
/// Force device and display, for the rows.
std::string device_text(const Session& session);
/// What limits the force: the protocol or, where that allows more, the device. Precondition: there is a force device.
std::string limit_text(const Protocol& protocol, const Session& session);
double force_limit_n(const Protocol& protocol, const Session& session);
/// Feedback and shading, for the operator.
std::string feedback_text(const Stimulus& shown);

/// Force passes the gate.
bool is_live(const ServoRecord& record);
/// As participants do: a force is felt, and it is the surface's.
bool touches(const ServoRecord& record);
/// Why no force passes.
std::string fault_text(const ServoRecord& record);

}  // namespace tangent::experiment
