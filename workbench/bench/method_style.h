// How each method is drawn in every figure: the colour-blind safe palette of Okabe & Ito, and a marker that stays
// visible where others lie on it.
#pragma once

#include "core/preset/preset.h"

#include <array>

namespace tangent::bench {

struct MethodStyle {
  Method method;
  const char* colour;
  const char* label;
  int point;  ///< of gnuplot: 7 round, for the smooth ones; 5 square
  double point_size;
};
inline constexpr std::array kMethodStyles{MethodStyle{Method::facet, "#E69F00", "facet", 5, 1.1},
                                          MethodStyle{Method::force_shading, "#CC79A7", "force shading", 5, 0.75},
                                          MethodStyle{Method::two_pass, "#56B4E9", "two-pass", 5, 0.4},
                                          MethodStyle{Method::paper, "#D55E00", "paper", 7, 0.5},
                                          MethodStyle{Method::newton, "#0072B2", "newton", 7, 0.8},
                                          MethodStyle{Method::robust, "#009E73", "robust", 7, 0.5}};

}  // namespace tangent::bench
