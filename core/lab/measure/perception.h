// Which edges of a mesh a finger would feel under a rendering condition.
//
// The thresholds are angles between adjacent facets of a curve (Doxon et al.). Intended edges (creases) and edges
// inside a flat face are counted separately.
#pragma once

#include "core/lab/measure/perception_thresholds.h"
#include "core/mesh/contact_mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tangent {

enum class EdgeSense : std::uint8_t {
  curve,     ///< between two facets of a curved surface
  flat,      ///< inside a flat face: angle below kFlatEdgeDeg
  crease,    ///< intended: the corner normals differ across it
  boundary,  ///< nothing on the other side
};

/// Degrees. Facets at a smaller angle belong to a flat face: coordinates printed with six digits turn them by less.
/// Sixteen times below the lowest threshold, so that nothing that could be felt is called flat.
inline constexpr double kFlatEdgeDeg = 0.01;

/// Per triangle and edge, as in the contact mesh.
struct FacetAngles {
  std::vector<std::array<float, 3>> angle_deg;  ///< between the facets, 0 to 180; 0 at a boundary
  std::vector<std::array<EdgeSense, 3>> sense;
};
/// Triangles that are not usable count as all boundary.
FacetAngles facet_angles(const ContactMesh& mesh);

struct FeltEdge {
  std::uint32_t triangle = kNone;  ///< the lower numbered of the two
  std::uint32_t edge = 0;
  double angle_deg = 0.0, length_m = 0.0;
  Vec3 middle_m{0.0};  ///< world
};

inline constexpr std::size_t kWorstEdges = 10;

/// Result of one condition on a mesh.
struct ConditionFeel {
  PerceptionThreshold threshold;
  std::uint64_t curve_edges = 0;  ///< total, to which shares refer
  std::uint64_t felt = 0;         ///< above the mean threshold
  std::uint64_t surely_felt = 0;  ///< above the confidence interval; as `felt` where there is none
  std::uint64_t doubtful = 0;     ///< within the confidence interval
  double curve_length_m = 0.0, felt_length_m = 0.0;
  std::vector<FeltEdge> worst;  ///< largest angles first, up to kWorstEdges, felt ones only
  double felt_share() const { return curve_edges ? static_cast<double>(felt) / static_cast<double>(curve_edges) : 0.0; }
  double felt_length_share() const { return curve_length_m > 0.0 ? felt_length_m / curve_length_m : 0.0; }
};

struct PerceptionAudit {
  std::uint64_t curve_edges = 0, flat_edges = 0, crease_edges = 0, boundary_edges = 0;
  double largest_curve_deg = 0.0, median_curve_deg = 0.0;
  std::array<ConditionFeel, kPerceptionThresholds.size()> conditions;  ///< in the order of kPerceptionThresholds
};
PerceptionAudit audit_perception(const ContactMesh& mesh, const FacetAngles& angles);

/// Index into kPerceptionThresholds; -1: no such condition.
int threshold_index(std::string_view condition);

/// One sentence on how the mesh feels under the condition, and under full shading.
std::string verdict(const PerceptionAudit& audit, int condition);

/// Largest angle between triangle t and a neighbour across an edge of a curve, rad; 0: it has none. Precondition:
/// usable.
double largest_curve_angle_rad(const ContactMesh& mesh, std::uint32_t t);

/// Heat map: per triangle its largest angle to a neighbour divided by the threshold's mean, curve edges only. Above 1
/// it is felt.
std::vector<float> felt_ratio(const FacetAngles& angles, const PerceptionThreshold& threshold);

}  // namespace tangent
