#include "workbench/cli/compare_report.h"

#include "workbench/cli/spectrum_json.h"
#include "workbench/cli/text_format.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace tangent {
namespace {

unsigned long long whole(std::uint64_t n) { return n; }

/// Lengths in micrometres.
std::string quantity_text(double value, std::string_view unit) {
  if (unit == "m") return format("%.6g um", 1e6 * value);
  return format("%.6g", value) + (unit == "1" ? "" : " " + std::string(unit));
}

std::string largest_text(const QuantityDifference& d, bool full) {
  if (full) return quantity_text(d.at_most, d.unit);
  return quantity_text(d.at_least, d.unit) + " to " + quantity_text(d.at_most, d.unit);
}

void print_quantities(const RecordingsCompared& c) {
  std::printf("%-12s %14s %30s %12s %14s %s\n", "", "RMS", "largest", "at tick", "tolerance",
              c.full ? "ticks over it" : "parts of 256 ticks over it");
  for (const QuantityDifference& d : c.quantities)
    std::printf("%-12s %14s %30s %12llu %14s %s\n", std::string(d.name).c_str(),
                c.full ? quantity_text(d.rms, d.unit).c_str() : "", largest_text(d, c.full).c_str(),
                whole(d.worst_tick), d.judged() ? quantity_text(d.tolerance, d.unit).c_str() : "",
                d.judged() ? std::to_string(d.over).c_str() : "");
}

}  // namespace

void print_compared(const RecordingsCompared& c, double seconds) {
  if (!c.alignment.aligned()) {
    std::printf("Not aligned: %s.\n", c.why.c_str());
    return;
  }
  std::printf("Aligned by %s: tick N of the first goes with N%+lld of the second, N from %llu to %llu.\n",
              std::string(kAlignByNames[static_cast<std::size_t>(c.alignment.by)]).c_str(),
              static_cast<long long>(c.alignment.shift), whole(c.alignment.first), whole(c.alignment.last));
  std::printf("%llu ticks compared%s in %.2f s; %llu with fingers too far apart, %llu in one only", whole(c.compared),
              c.full ? "" : " by their minima and maxima", seconds, whole(c.apart), whole(c.in_one_only));
  std::printf(c.full ? ", %llu with a contact in one only.\n" : ".\n", whole(c.other_contacts));
  print_quantities(c);
  if (c.outcome == CompareOutcome::not_aligned)
    std::printf("Not aligned: %s.\n", c.why.c_str());
  else if (c.outcome == CompareOutcome::undecided)
    std::puts("Undecided: minima and maxima leave it open; without --coarse every tick is compared.");
  else
    std::puts(c.outcome == CompareOutcome::same ? "The same, within the tolerances." : "Different.");
}

nlohmann::ordered_json compared_json(const RecordingsCompared& c) {
  nlohmann::ordered_json json{{"format", 1},
                              {"outcome", to_string(c.outcome)},
                              {"why_not_aligned", c.why},
                              {"aligned_by", kAlignByNames[static_cast<std::size_t>(c.alignment.by)]},
                              {"shift_ticks", c.alignment.shift},
                              {"first_tick", c.alignment.first},
                              {"last_tick", c.alignment.last},
                              {"full", c.full},
                              {"ticks_compared", c.compared},
                              {"ticks_apart", c.apart},
                              {"ticks_in_one_only", c.in_one_only},
                              {"ticks_with_another_contact", c.other_contacts},
                              {"quantities", nlohmann::ordered_json::array()}};
  for (const QuantityDifference& d : c.quantities) {
    nlohmann::ordered_json quantity{{"name", d.name}, {"unit", d.unit}};
    if (c.full) quantity["rms"] = d.rms;
    quantity["largest_at_least"] = d.at_least;
    quantity["largest_at_most"] = d.at_most;
    quantity["at_tick"] = d.worst_tick;
    if (d.judged()) {
      quantity["tolerance"] = d.tolerance;
      quantity["over"] = d.over;
    }
    json["quantities"].push_back(std::move(quantity));
  }
  if (c.full) json["spectra"] = {{"first", spectrum_json(c.spectrum_a)}, {"second", spectrum_json(c.spectrum_b)}};
  return json;
}

}  // namespace tangent
