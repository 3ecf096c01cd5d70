// A simulated participant through a whole protocol, into the same files that a person's answers go into.
#pragma once

#include "workbench/experiment/experiment_folder.h"

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace tangent::experiment {

inline constexpr std::array<std::string_view, 2> kSimulatedKinds{
    "known",     ///< answers by a known law, drawn after the paper's tables (simulated_group.h)
    "feeling"};  ///< touches the stimuli with the simulated hand and judges by force and display (feeling.h)

struct SimulatedOutcome {
  std::filesystem::path rows;
  std::size_t before = 0, made = 0;  ///< rows
  bool stopped = false;
};

/// All sessions. Goes on where the files end. `protocol_text`: the protocol's file, kept beside the data. `stop`: asked
/// after each row.
Result<SimulatedOutcome> run_simulated(const std::filesystem::path& folder, const Protocol& protocol,
                                       const std::string& protocol_text, const Enrolment& enrolment,
                                       const std::function<bool()>& stop);

/// The seed of one who was given none: the same for a name and a protocol.
std::uint64_t default_seed(const std::string& participant, const std::string& protocol_digest);

}  // namespace tangent::experiment
