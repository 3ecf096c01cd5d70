#include "core/base/text.h"
#include "core/lab/explain/explain_tick.h"

#include <cmath>
#include <cstdio>
#include <string_view>

namespace tangent {
namespace {

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}
std::string unit_text(const PresetKey& key) {
  return key.unit.empty() || key.unit == "1" ? "" : " " + std::string(key.unit);
}

/// Four digits, lengths in millimetres.
std::string number_text(double value, std::string_view unit) {
  if (unit == "m") return short_text(1e3 * value) + " mm";
  std::string out = short_text(value);
  return unit == "1" || unit.empty() ? out : out + " " + std::string(unit);
}

std::string decided_text(const DecidingNumber& d) {
  return std::string(d.what) + " " + number_text(d.value, d.unit) + " against " + number_text(d.threshold, d.unit) +
         " (" + d.against + "), by " + number_text(std::abs(d.margin()), d.unit);
}

std::string iterations_text(int count) { return std::to_string(count) + (count == 1 ? " iteration" : " iterations"); }

std::string place_text(const TickExplanation& e) {
  std::string text = (e.mesh.planar ? " At vertex " : " At triangle ") + std::to_string(e.mesh.triangle);
  const bool of_edge = e.cause == TickCause::crease || e.cause == TickCause::boundary;
  if (of_edge && !e.mesh.planar) text += ", edge " + std::to_string(e.mesh.side);
  if (e.cause == TickCause::wild_normal) text += ", corner " + std::to_string(e.mesh.side);
  const Vec3& p = e.mesh.place;
  char place[96];
  std::snprintf(place, sizeof place, " (%.4g, %.4g, %.4g mm)", 1e3 * p.x, 1e3 * p.y, 1e3 * p.z);
  text += place;
  if (e.mesh.mended)
    text += std::string("; with it ") + (e.cause == TickCause::unready ? "built" : "mended") + " the tick is plain (" +
            iterations_text(e.mesh.proof.iterations) + ")";
  return text + ".";
}

std::string cure_text(const TickCure& cure, bool from_first) {
  if (cure.outcome == CureOutcome::not_sought) return {};
  if (cure.outcome == CureOutcome::none_in_range)
    return " No value of a parameter that has to do with it cures it within its range.";
  const auto value = [&](double x) {
    return cure.key->kind == KeyKind::number ? short_text(x) + unit_text(*cure.key) : cure.key->value_text(x);
  };
  std::string text = " Cured by " + cure.key->full_name() + " = " + value(cure.to) + " instead of " + value(cure.from);
  if (cure.as_deep) text += ", as deep";
  return text + " (solved again" + (from_first ? " from that tick on, every one with a contact: " : ": ") +
         to_string(cure.proof.status) + ", " + iterations_text(cure.proof.iterations) + ").";
}

}  // namespace

const char* sentence_of(const TickExplanation& e) {
  if (e.cause == TickCause::unstable_ground && e.untouched)
    return "Unstable ground: the finger touches nothing, and its centre is so far from a hollow that no one place is "
           "nearest";
  return sentence_of(e.cause);
}

std::string explanation_text(const TickExplanation& e) {
  std::string text;
  if (e.lost_before > 0)
    text = "The contact was lost " + std::to_string(e.lost_before) +
           (e.lost_before == 1 ? " tick before" : " ticks before") + ", and not found since. What lost it: ";
  text += sentence_of(e);
  if (e.decided.what) text += ": " + decided_text(e.decided);
  text += ".";
  if (e.mesh.triangle != kNone) text += place_text(e);
  return text + cure_text(e.cure, e.lost_before > 0);
}

}  // namespace tangent
