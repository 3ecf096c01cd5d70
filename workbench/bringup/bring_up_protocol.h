// The protocol of a bring-up, which an owner can send as evidence: a file for programs, and the same as a page to read.
#pragma once

#include "core/base/result.h"
#include "devices/force_device.h"
#include "workbench/bringup/bring_up_facts.h"

#include <filesystem>
#include <string>

namespace tangent {

struct BringUpProtocol {
  std::string kind;           ///< as --force calls it
  ForceCapabilities device;   ///< what it says about itself
  std::string date, program;  ///< "2026-11-23T16:00:00Z"; version
  std::string cable;          ///< what the driver said of the cable; empty: nothing
  Error opening;              ///< why it could not be opened; `what` empty: it could
  double most_n = 0.0;        ///< limit of the forces
  BringUpView result;
};

/// One that was not even opened; `attached`: it is there, but may not be opened, or is in use.
BringUpProtocol unopened_protocol(const std::string& kind, const ForceCapabilities& device, const Error& why,
                                  bool attached);

std::string protocol_json(const BringUpProtocol& protocol);
std::string protocol_page(const BringUpProtocol& protocol);  ///< Markdown
/// Both: `file`, and beside it the same name with .md. Fails where one can't be written.
Status write_protocol(const BringUpProtocol& protocol, const std::filesystem::path& file);
/// Now, in UTC.
std::string protocol_date();

}  // namespace tangent
