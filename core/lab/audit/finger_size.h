// Does the finger fit the mesh: a slip of units makes either a thousand times too large.
#pragma once

#include "core/finger/finger.h"
#include "core/mesh/contact_mesh.h"

#include <string>

namespace tangent {

/// A finger that reaches more than this many longest sides of the mesh is remarked on. At 20 mm it takes a mesh of
/// under 0.2 mm; the contact itself is found at any ratio.
inline constexpr double kFingerToMesh = 100.0;

/// A mesh longer than this many reaches of the finger is remarked on, too: at 20 mm it takes 8 m, and at 1 mm 40 cm.
inline constexpr double kMeshToFinger = 400.0;

/// Of a mesh or polygon whose longest side is `longest_m`: empty where the finger's size is plausible; else both sizes,
/// and which options to check.
std::string finger_size_note(double longest_m, const Finger& finger);

double longest_side_m(const ContactMesh& mesh);  ///< of its box

}  // namespace tangent
