#include "workbench/sweep/ignored_keys.h"

#include "core/tick/sources.h"

#include <algorithm>

namespace tangent::sweep {
namespace {

constexpr std::uint64_t kMostLookedAt = 4096;  // presets of a plan

/// "paper", "paper, newton and robust".
std::string names_of(Methods methods) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < kMethodNames.size(); ++i)
    if (methods.has(static_cast<Method>(i))) names.emplace_back(kMethodNames[i]);
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

std::string sentence(const PresetKey& key, const std::string& under, const std::string& why) {
  return key.full_name() + " changes nothing under " + under + ": " + why;
}

}  // namespace

std::string why_ignored(const PresetKey& key, const Preset& preset) {
  if (key.table == "controller") return "the display's controller has it, and no tick reads it";
  if (key.planar_only) return "2D scenes alone read it";
  if (key.key == "contacts") {  // of the smooth surface, whoever finds the contact
    Preset all = preset;
    all.force.contacts = ForceContacts::all;
    return wants_touched(all) ? "" : "the force does not come from the smooth surface";
  }
  const Method method = reported_method(preset);
  if (key.read_by != kNoMethod && !key.read_by.has(method))
    return names_of(key.read_by) + " alone " + (key.read_by.bits & (key.read_by.bits - 1) ? "read it" : "reads it");
  if (!key.condition.holds || key.condition.holds(preset)) return {};
  if (key.condition.otherwise.empty()) return "a finger of this shape has none";
  return "force.damping_n_s_per_m is 0";
}

std::vector<std::string> ignored_key_texts(const Cells& cells) {
  const Plan& plan = cells.plan();
  std::vector<std::string> out;
  // Before they are read nobody knows which of these are polygons.
  const bool may_be_planar = std::any_of(plan.meshes.begin(), plan.meshes.end(), [](const auto& mesh) {
    return mesh.extension() == ".csv" || mesh.extension() == ".obj";
  });
  for (const Range& range : plan.ranges) {
    if (range.key->planar_only && may_be_planar) continue;
    Methods under = kNoMethod;
    std::string why;
    for (const Method method : plan.methods) {
      std::string of_method;
      const std::uint64_t step = std::max<std::uint64_t>(1, cells.size() / kMostLookedAt);
      for (std::uint64_t i = 0; i < cells.size(); i += step) {
        const Cell cell = cells.at(i);
        if (plan.methods[cell.method] != method) continue;
        of_method = why_ignored(*range.key, cells.preset(cell));
        if (of_method.empty()) break;
      }
      if (of_method.empty()) continue;
      under.bits |= only(method).bits;
      why = of_method;
    }
    if (under != kNoMethod) out.push_back(sentence(*range.key, names_of(under), why));
  }
  return out;
}

std::vector<std::string> ignored_key_texts(std::span<const Range> ranges, const Preset& base) {
  std::vector<std::string> out;
  for (const Range& range : ranges) {
    // The other ranges may be what makes it count: each at both of its ends.
    std::string why;
    for (std::size_t ends = 0; ends < (std::size_t{1} << std::min<std::size_t>(ranges.size(), 12)); ++ends) {
      Preset preset = base;
      for (std::size_t r = 0; r < ranges.size(); ++r)
        ranges[r].key->set(preset, ranges[r].at(ends >> r & 1 ? 1.0 : 0.0));
      why = why_ignored(*range.key, preset);
      if (why.empty()) break;
    }
    if (!why.empty())
      out.push_back(sentence(*range.key, std::string(kMethodNames[static_cast<std::size_t>(base.solver.method)]), why));
  }
  return out;
}

}  // namespace tangent::sweep
