#include "workbench/sweep/cell_numbers.h"

#include "workbench/sweep/cell_meter.h"

namespace tangent::sweep {
namespace {

constexpr std::array kColumns{
    NumberColumn{"ticks", "ticks solved", &CellNumbers::ticks},
    NumberColumn{"unconverged", "ticks that did not converge", &CellNumbers::unconverged},
    NumberColumn{"facing", "ticks at which the surface offers no contact", &CellNumbers::facing},
    NumberColumn{"events_first", "ticks by event: the first contact", &CellNumbers::events_first},
    NumberColumn{"events_reseed", "looked for anew", &CellNumbers::events_reseed},
    NumberColumn{"events_switch", "a deeper place took over", &CellNumbers::events_switch},
    NumberColumn{"events_branch", "the solution folded", &CellNumbers::events_branch},
    NumberColumn{"not_finite", "ticks with a NaN or an infinity", &CellNumbers::not_finite},
    NumberColumn{"unmarked_jumps", "ticks without event whose normal leapt", &CellNumbers::unmarked_jumps},
    NumberColumn{"mean_iterations", "planes a tick", &CellNumbers::mean_iterations},
    NumberColumn{"p99_iterations", "planes, 99th percentile", &CellNumbers::p99_iterations},
    NumberColumn{"most_iterations", "planes, most", &CellNumbers::most_iterations, true},
    NumberColumn{"mean_counted_us", "time of a tick by its counted work", &CellNumbers::mean_counted_us},
    NumberColumn{"p99_counted_us", "99th percentile", &CellNumbers::p99_counted_us},
    NumberColumn{"residual_worst_m", "the method's own error, worst converged tick", &CellNumbers::residual_worst_m,
                 true},
    NumberColumn{"compared", "ticks compared with the exact solution", &CellNumbers::compared},
    NumberColumn{"error_p50_m", "distance from it, median", &CellNumbers::error_p50_m},
    NumberColumn{"error_p99_m", "99th percentile", &CellNumbers::error_p99_m},
    NumberColumn{"error_worst_m", "worst", &CellNumbers::error_worst_m, true},
    NumberColumn{"force_change_mean_n", "change of the force from tick to tick", &CellNumbers::force_change_mean_n},
    NumberColumn{"force_unexplained", "ticks at which it leapt", &CellNumbers::force_unexplained},
    NumberColumn{"force_unexplained_worst_n", "by most", &CellNumbers::force_unexplained_worst_n, true},
    NumberColumn{"display_change_mean_m", "change of the display from tick to tick",
                 &CellNumbers::display_change_mean_m},
    NumberColumn{"display_unexplained", "ticks at which it leapt", &CellNumbers::display_unexplained},
    NumberColumn{"display_unexplained_worst_m", "by most", &CellNumbers::display_unexplained_worst_m, true},
    NumberColumn{"loops", "circles with a contact all the way round", &CellNumbers::loops},
    NumberColumn{"closed_work_share", "largest work round one, over its peak energy", &CellNumbers::closed_work_share,
                 true},
};

}  // namespace

std::span<const NumberColumn> number_columns() { return kColumns; }

std::optional<CellNumbers> measure_cell(Stepper& stepper, Stepper& exact, const Preset& preset,
                                        std::span<const TickInput> motion, const std::function<bool()>& stop) {
  return CellMeter(stepper, exact, preset).run(motion, kCircles, stop);
}

}  // namespace tangent::sweep
