#include "workbench/experiment/protocol.h"

#include "core/base/fnv.h"
#include "core/base/text.h"
#include "core/preset/schema.h"

namespace tangent::experiment {
namespace {

/// Values as text, one after the other.
class Values {
 public:
  Values& add(std::string_view text) { return fnv_.add(text).add("\n"), *this; }
  Values& add(double value) {
    std::string text;
    append_double(text, value);
    return add(text);
  }
  Values& add_all(const std::vector<std::string>& texts) {
    add(static_cast<double>(texts.size()));
    for (const std::string& text : texts) add(text);
    return *this;
  }
  std::string digest() const { return fnv_.text(); }

 private:
  Fnv fnv_;
};

void add(Values& values, const StaircaseRule& rule) {
  values.add(kStepScaleNames[static_cast<std::size_t>(rule.scale)]);
  values.add(rule.start).add(rule.large_step).add(rule.small_step).add(rule.fewest).add(rule.most);
  for (const int whole : {rule.large_reversals, rule.reversals, rule.averaged, rule.down, rule.most_trials})
    values.add(whole);
}

void add(Values& values, const Discrimination& d) {
  values.add(d.radius_m).add(d.angle_rad).add(static_cast<double>(d.placement));
  for (const ComparisonCondition& condition : d.conditions) {
    values.add(condition.name);
    add(values, condition.staircase);
  }
}

void add(Values& values, const Identification& d) {
  values.add_all(d.objects).add_all(d.both_ways).add(d.practice).add(d.rounding_m).add(d.facet_deg);
  for (const int whole : {d.sessions, d.blocks, d.runs, d.tactile_first_even ? 1 : 0}) values.add(whole);
  for (const double number :
       {d.start_m.x, d.start_m.y, d.start_m.z, d.start_radius_m, d.hold_s, d.guide_n_per_m, d.guide_limit_n})
    values.add(number);
  // Protocols from before there was this value keep their digest.
  if (d.hours_between_sessions != Identification{}.hours_between_sessions) values.add(d.hours_between_sessions);
}

}  // namespace

std::string preset_digest(const Preset& preset) {
  Values values;
  for (const PresetKey& key : preset_keys()) values.add(key.full_name()).add(key.get(preset));
  return values.digest();
}

std::string protocol_digest(const Protocol& protocol) {
  Values values;
  values.add(kProtocolKinds[protocol.kind.index()]).add(protocol.name).add(protocol.version);
  for (const PresetKey& key : preset_keys()) values.add(key.full_name()).add(key.get(protocol.preset));
  values.add(protocol.sound.noise_db).add(protocol.sound.cue_db);
  std::visit([&](const auto& kind) { add(values, kind); }, protocol.kind);
  return values.digest();
}

}  // namespace tangent::experiment
