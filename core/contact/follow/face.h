// The contact on a face: one plane of the iteration, by the paper's step, Newton's or the safeguarded one.
#pragma once

#include "core/contact/follow/run.h"

namespace tangent {

/// One iteration from a face: now.sample and now.contact in, now.plane moved on. True to go on; else now.stop says why
/// not.
bool iterate_face(ContactContext& context, int budget, RunMemory& memory, IterationResult& now);

}  // namespace tangent
