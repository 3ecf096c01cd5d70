// What a plan is, in 16 hex digits: its values and the bytes of every file that it reads. Results of two plans never
// mix.
#pragma once

#include "workbench/sweep/plan.h"

namespace tangent::sweep {

/// A file that is missing counts as missing: cells that read it fail, the others don't.
std::string plan_digest(const Plan& plan);

// Its parts, to tell what of a plan has changed.
std::string plan_values_digest(const Plan& plan);               ///< all but what is in the files
std::vector<std::string> plan_input_digests(const Plan& plan);  ///< of each mesh, then of each motion

}  // namespace tangent::sweep
