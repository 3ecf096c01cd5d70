#include "workbench/sweep/plan.h"

#include "core/base/text.h"

#include <algorithm>
#include <cmath>

namespace tangent::sweep {
namespace {

constexpr double kLeastPressMm = 1e-3, kMostPressMm = 20.0;

}  // namespace

double Range::at(double share) const {
  if (!values.empty()) {
    const auto i = static_cast<std::size_t>(share * static_cast<double>(values.size()));
    return values[std::min(i, values.size() - 1)];
  }
  double value = logarithmic ? from * std::pow(to / from, share) : from + share * (to - from);
  if (share >= 1.0) value = to;
  return key->kind == KeyKind::number ? value : std::round(value);
}

std::optional<double> Range::share_of(double value) const {
  if (!values.empty()) {
    const auto found = std::find(values.begin(), values.end(), value);
    if (found == values.end()) return std::nullopt;
    return (static_cast<double>(found - values.begin()) + 0.5) / static_cast<double>(values.size());
  }
  if (!(value >= std::min(from, to) && value <= std::max(from, to))) return std::nullopt;
  if (from == to) return 0.0;
  const double share = logarithmic ? std::log(value / from) / std::log(to / from) : (value - from) / (to - from);
  return std::clamp(share, 0.0, 1.0);
}

std::vector<double> Range::grid() const {
  if (!values.empty()) return values;
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i) {
    const double value = at(count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 0.0);
    if (out.empty() || out.back() != value) out.push_back(value);
  }
  return out;
}

std::optional<MadeMotion> made_motion(std::string_view poses) {
  const std::size_t colon = poses.find(':');
  const auto kind = std::find(kMadePoses.begin(), kMadePoses.end(), poses.substr(0, colon));
  if (kind == kMadePoses.end()) return std::nullopt;
  MadeMotion out{static_cast<std::size_t>(kind - kMadePoses.begin()), {}};
  if (colon == std::string_view::npos) return out;
  const std::string_view depth = poses.substr(colon + 1);
  if (!depth.ends_with("mm")) return std::nullopt;
  const auto mm = parse_finite_double(depth.substr(0, depth.size() - 2));
  if (!mm || *mm < kLeastPressMm || *mm > kMostPressMm) return std::nullopt;
  out.press_m = *mm * 1e-3;
  return out;
}

Status check_made_motion(std::string_view poses) {
  const std::string_view kind = poses.substr(0, poses.find(':'));
  const bool named = std::find(kMadePoses.begin(), kMadePoses.end(), kind) != kMadePoses.end();
  if (!named || is_made(poses)) return {};
  return fail(std::string(poses) + " has no mean depth that can be made", "poses",
              "write it as " + std::string(kind) + ":0.5mm; allowed: " + range_text(kLeastPressMm, kMostPressMm, "mm"));
}

namespace {

/// The place of the first that equals one before it.
template <class Items>
std::optional<std::size_t> twice(const Items& items) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (std::find(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(i), items[i]) !=
        items.begin() + static_cast<std::ptrdiff_t>(i))
      return i;
  return std::nullopt;
}

Status check_range(const Range& range, Sampling sampling) {
  const std::string where = "range of " + range.key->full_name();
  std::vector<double> ends = range.values;
  if (ends.empty()) ends = {range.from, range.to};
  for (const double value : ends) {
    if (!range.key->allows(value))
      return fail(range.key->value_text(value) + " is not allowed", where, "allowed: " + range.key->allowed());
  }
  if (!range.values.empty()) return {};
  if (range.from >= range.to) return fail("is empty: from is not below to", where, "let it grow");
  if (range.logarithmic && range.from <= 0.0)
    return fail("a logarithmic range can't begin at 0 or below", where, "begin above 0, or use scale = \"linear\"");
  if (sampling == Sampling::grid && range.count < 2)
    return fail("needs a count of at least 2 in a grid", where, "write count = N, or list the values");
  if (sampling != Sampling::grid && range.count > 0)
    return fail("count belongs to a grid", where, "leave it out: samples says how many are taken");
  return {};
}

}  // namespace

Status check_plan(const Plan& plan) {
  if (plan.meshes.empty()) return fail("no mesh is named", "meshes", "name one at least");
  if (plan.poses.empty())
    return fail("no motion is named", "poses", "name a pose file, a recording, around or strokes");
  if (plan.methods.empty()) return fail("no method is named", "methods", "allowed: " + choices_text(kMethodNames));
  for (const std::string& poses : plan.poses)
    if (Status ok = check_made_motion(poses); !ok) return ok;
  if (const auto i = twice(plan.meshes))
    return fail(plan.meshes[*i].string() + " is there twice", "meshes", "leave one of them out");
  if (const auto i = twice(plan.poses))
    return fail(plan.poses[*i] + " is there twice", "poses", "leave one of them out");
  if (const auto i = twice(plan.methods))
    return fail(std::string(to_string(plan.methods[*i])) + " is there twice", "methods", "leave one of them out");
  if (plan.fingers.empty()) return fail("no finger is named", "fingers", "name one, or leave the table out");
  if (plan.sampling == Sampling::grid && plan.samples > 0)
    return fail("samples contradicts sampling = \"grid\"", "samples", "leave it out, or name another sampling");
  if (plan.sampling != Sampling::grid && plan.samples == 0)
    return fail(
        "sampling = \"" + std::string(kSamplingNames[static_cast<std::size_t>(plan.sampling)]) + "\" needs samples",
        "samples", "write samples = N");
  if (plan.sampling != Sampling::grid && plan.ranges.empty())
    return fail("there is nothing to sample", "ranges", "name a range, or use sampling = \"grid\"");
  for (std::size_t i = 0; i < plan.ranges.size(); ++i) {
    if (Status ok = check_range(plan.ranges[i], plan.sampling); !ok) return ok;
    const std::string name = plan.ranges[i].key->full_name();
    if (name == "solver.method")
      return fail("is set by methods", "range of " + name, "list them there, and leave the range out");
    const bool of_finger = plan.ranges[i].key->table == "finger";
    if (of_finger && plan.fingers.size() > 1)
      return fail("contradicts several fingers", "range of " + name, "list fingers, or sweep the key of one");
    for (std::size_t k = 0; k < i; ++k) {
      if (plan.ranges[k].key == plan.ranges[i].key)
        return fail("is there twice", "range of " + name, "leave one of them out");
    }
  }
  return {};
}

}  // namespace tangent::sweep
