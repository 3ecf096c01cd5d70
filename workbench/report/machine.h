// What the program runs on, for the page: times mean nothing without it.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tangent {

/// Processor, cores, whether it is a virtual machine, memory, system, kernel, load; as far as the system tells. No name
/// of the machine or its user.
std::vector<std::pair<std::string, std::string>> machine_facts();

/// "2026-11-23T04:12:29Z"
std::string utc_now();

}  // namespace tangent
