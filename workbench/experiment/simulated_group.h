// Simulated participants as the paper's were: thresholds that vary from one to the next as Table 1 says, confusions of
// Table 3. What comes out of an analysis of such a group shows what the analysis finds, and nothing about hands.
#pragma once

#include "workbench/experiment/participant.h"

namespace tangent::experiment {

/// Thresholds (at 70.7 %) drawn from logarithmic normal distributions with the means and deviations that Table 1 and
/// its intervals stand for; conditions that the paper measured in its pilot alone (P1, P2) have Table 2's angle and the
/// deviation of C4.
KnownComparer comparer_like_the_papers(const Protocol& protocol, std::uint64_t participant, std::uint64_t seed);

/// Confusions of Table 3, whatever shading and feedback. Objects that are not in it are named by chance.
KnownNamer namer_like_the_papers(const Identification& design);

}  // namespace tangent::experiment
