// A tick's base triangle in the plane, with its neighbours unfolded about the edges (as the paper's walk crosses them),
// and over it the residual |c - h N - S| that the iteration drives to zero, for a tangent plane at (u, v). Pure
// geometry; the panel draws it.
//
// Flat coordinates: metres, corner 0 at the origin, corner 1 on +x, corner 2 above. Outside the four triangles the
// nearest one's polynomial is extrapolated, so that contours continue; `inside` tells them apart.
#pragma once

#include "core/tick/step.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace tangent {

struct FlatTriangle {
  std::uint32_t triangle = kNone;
  std::array<Vec2, 3> corners;  ///< flat
};

/// The visible range of flat coordinates.
struct FlatView {
  Vec2 min{0.0}, max{1.0};
  Vec2 size() const { return max - min; }
};

struct ContourSegment {
  Vec2 a, b;
  int level = 0;  ///< half decades: the residual is 10^(level / 2) m
};

class ResidualMap {
 public:
  /// Precondition: the triangle is usable. `input`: the finger's pose, world.
  ResidualMap(std::shared_ptr<const ContactScene> scene, std::uint32_t triangle, const Finger& finger, NormalForm form,
              const TickInput& input);

  std::span<const FlatTriangle> triangles() const { return triangles_; }  ///< [0]: the base
  /// Flat position of a plane's contact; empty when it lies on none of the four triangles.
  std::optional<Vec2> place(std::uint32_t triangle, double u, double v) const;
  /// Residual at a flat point, m.
  double residual(const Vec2& at) const;
  bool inside(const Vec2& at) const;

  /// The base triangle, whole.
  FlatView whole_view() const;
  /// The range of all planes that have a flat position, with a margin; the whole triangle if there is none.
  FlatView path_view(std::span<const IterationRecord> path) const;

  /// Samples the residual on a grid of columns x rows nodes, row by row from min.
  void sample(const FlatView& view, int columns, int rows);
  const std::vector<float>& log_residuals() const { return log_; }  ///< log10 of the nodes, m
  std::vector<ContourSegment> contours() const;                     ///< contours of the samples, at every half decade
  const FlatView& sampled_view() const { return view_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }

 private:
  struct Located {
    std::size_t index = 0;  ///< into triangles_
    double u = 0.0, v = 0.0;
    double outside = 0.0;  ///< most negative weight, negated; 0: inside
  };
  Located locate(const Vec2& at) const;

  std::shared_ptr<const ContactScene> scene_;
  Finger finger_;
  FingerPose local_;
  std::vector<FlatTriangle> triangles_;
  std::vector<PnPatch> patches_;
  FlatView view_;
  int columns_ = 0, rows_ = 0;
  std::vector<float> log_;
};

}  // namespace tangent
