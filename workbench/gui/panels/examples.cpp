#include "workbench/gui/panels/examples.h"

#include <array>

namespace tangent {

namespace {

constexpr std::array kExamples{
    Example{"A mesh that makes trouble", "A thin fin on a plate: its defects, and where a finger can't rest",
            "mesh fin_on_plate\n"
            "method robust\n"
            "map touch-radius\n"
            "panel Inspect\n"
            "wait for work\n"
            "worst place\n"
            "say The map shows where the finger touches two walls. W goes to the next worst place, Inspect lists "
            "defects\n"},
    Example{"Gains that fail", "The paper's iteration with a curvature gain that is too small, on a torus",
            "mesh torus\n"
            "method paper\n"
            "curvature gain 2.5\n"
            "map failures\n"
            "panel Map\n"
            "wait for work\n"
            "worst place\n"
            "run 3000\n"
            "pause on\n"
            "tab look\n"
            "say Red is where it fails. Drag Curvature gain G_k towards 20 mm: the past is solved again and drawn "
            "beside\n"},
    Example{
        "A device fault", "The simulated force device drops out: what the gate does, and how to arm again",
        "mesh torus\n"
        "method robust\n"
        "run 2000\n"
        "inject into force device drop-out\n"
        "run 500\n"
        "device monitor on\n"
        "tab devices\n"
        "say The gate stopped the force. The monitor has the fault in its log; Clear fault and arm is one attempt\n"}};

}  // namespace

std::span<const Example> examples() { return kExamples; }

}  // namespace tangent
