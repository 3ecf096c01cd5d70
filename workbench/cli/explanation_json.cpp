#include "workbench/cli/explanation_json.h"

#include <nlohmann/json.hpp>

namespace tangent {
namespace {

using OrderedJson = nlohmann::ordered_json;

const char* outcome_name(CureOutcome outcome) {
  switch (outcome) {
    case CureOutcome::found:
      return "found";
    case CureOutcome::none_in_range:
      return "none-in-range";
    default:
      return "not-sought";
  }
}

OrderedJson decided_json(const DecidingNumber& decided) {
  if (!decided.what) return nullptr;
  return {{"what", decided.what},   {"against", decided.against},     {"unit", decided.unit},
          {"value", decided.value}, {"threshold", decided.threshold}, {"margin", decided.margin()}};
}

OrderedJson cure_json(const TickCure& cure) {
  OrderedJson json{{"outcome", outcome_name(cure.outcome)}};
  if (cure.outcome != CureOutcome::found) return json;
  json["key"] = cure.key->full_name();
  json["unit"] = cure.key->unit;
  json["from"] = cure.key->value_text(cure.from);
  json["to"] = cure.key->value_text(cure.to);
  json["as_deep"] = cure.as_deep;
  json["then"] = {{"status", to_string(cure.proof.status)}, {"planes", cure.proof.iterations}};
  return json;
}

OrderedJson place_json(const MeshPlace& place) {
  if (place.triangle == kNone) return nullptr;
  OrderedJson json{{place.planar ? "vertex" : "triangle", place.triangle},
                   {"side", place.side},
                   {"x_m", place.place.x},
                   {"y_m", place.place.y},
                   {"z_m", place.place.z},
                   {"mended", place.mended}};
  if (place.mended) json["then"] = {{"status", to_string(place.proof.status)}, {"planes", place.proof.iterations}};
  return json;
}

}  // namespace

nlohmann::ordered_json explained_tick_json(const ExplainedTick& e) {
  return {{"tick", e.tick},
          {"t_s", e.t_s},
          {"status", to_string(e.why.tick.status)},
          {"event", to_string(e.why.tick.event)},
          {"planes", e.why.tick.iterations},
          {"same_bits", e.same_bits},
          {"cause", to_string(e.why.cause)},
          {"text", explanation_text(e.why)},
          {"decided", decided_json(e.why.decided)},
          {"cure", cure_json(e.why.cure)},
          {"place", place_json(e.why.mesh)},
          {"solves", e.why.solves},
          {"lost_before", e.why.lost_before}};
}

nlohmann::ordered_json explained_recording_json(const ExplainedRecording& explained) {
  OrderedJson json{{"format", 1},
                   {"ticks", explained.ticks},
                   {"wanted", explained.wanted},
                   {"explained", explained.explained},
                   {"complete", !explained.cancelled},
                   {"causes", OrderedJson::array()}};
  for (const CauseInRecording& cause : explained.causes)
    json["causes"].push_back({{"cause", to_string(cause.cause)},
                              {"sentence", sentence_of(cause.cause)},
                              {"ticks", cause.ticks},
                              {"worst", explained_tick_json(cause.worst)}});
  return json;
}

}  // namespace tangent
