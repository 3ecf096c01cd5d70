#include "workbench/sweep/gain_theory.h"

#include "core/finger/plane_contact.h"
#include "core/lab/gains/paper_contraction.h"
#include "core/surface/mesh_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace tangent::sweep {
namespace {

constexpr std::size_t kLookedAtEvery = 8, kAskStride = 512;
constexpr double kClearPlanes = 0.02, kSameStep = 0.05, kSameContraction = 0.1;

double middle_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Preset with_paper_gains(Preset preset, const Gains& gains) {
  preset.solver = with_gains(preset.solver, gains);
  preset.solver.method = Method::paper;
  return preset;
}

/// What is gathered at the contacts on faces.
class Contacts {
 public:
  Contacts(const ContactScene& scene, const Preset& found, const Preset& rule)
      : mesh_(scene.mesh()), found_(found), rule_(rule) {}

  void add(const TickOutput& output) {
    if (output.status != TickStatus::face || output.penetration_m <= 0.0) return;
    const PnPatch patch = make_patch(mesh_, output.triangle, found_.solver.normal_form);
    const SurfaceSample s = evaluate(patch, output.u, output.v);
    const PrincipalCurvatures k = principal_curvatures(s, evaluate_second(patch, output.u, output.v));
    const FingerPose pose = pose_touching(found_.finger, s, output.penetration_m);
    const double h = contact_on_plane(found_.finger, pose, s.point, s.normal).height_m;
    const double curvature = std::max(std::abs(k.k1), std::abs(k.k2));
    heights_ += h;
    curvatures_ += curvature;
    ++count_;
    if (ground_of(mesh_, found_, output) != tangent::Ground::tight) return;
    turns_.push_back(h * curvature);
    round_.push_back(std::min(std::abs(k.k1), std::abs(k.k2)) / curvature);
    rule_left_.push_back(paper_contraction(mesh_, output.triangle, s, rule_, output.penetration_m));
    found_left_.push_back(paper_contraction(mesh_, output.triangle, s, found_, output.penetration_m));
  }

  void put_into(GainTheory& out) const {
    if (count_ > 0.0) {
      out.height_mean_m = heights_ / count_;
      out.curvature_mean_per_m = curvatures_ / count_;
    }
    out.edge_turn = middle_of(turns_);
    out.edge_theory = out.edge_turn / (2.0 + out.edge_turn);
    out.edge_roundness = middle_of(round_);
    out.edge_rule = middle_of(rule_left_);
    out.edge_found = middle_of(found_left_);
  }

 private:
  const ContactMesh& mesh_;
  const Preset &found_, &rule_;
  double heights_ = 0.0, curvatures_ = 0.0, count_ = 0.0;
  std::vector<double> turns_, round_, rule_left_, found_left_;
};

/// Mean planes a tick; empty: told to stop.
std::optional<double> run_paper(const std::shared_ptr<const ContactScene>& scene, const Preset& preset,
                                std::span<const TickInput> motion, const std::function<bool()>& stop,
                                GroundCounts& grounds, Contacts* contacts) {
  Stepper stepper(scene);
  TickState state;
  double planes = 0.0;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    if (stop && i % kAskStride == 0 && stop()) return std::nullopt;
    const TickOutput output = stepper.step(preset, motion[i], state);
    planes += output.iterations;
    if (output.triangle != kNone) grounds.add(ground_of(scene->mesh(), preset, output), output.iterations);
    if (contacts != nullptr && i % kLookedAtEvery == 0) contacts->add(output);
  }
  return planes / static_cast<double>(std::max<std::size_t>(1, motion.size()));
}

double step_at(const Gains& gains, double curvature) { return gains.overall / (1.0 + gains.curvature_m * curvature); }

double apart(double a, double b) { return std::abs(a - b) / std::max(std::abs(a), std::abs(b)); }

std::vector<GainCause> causes_of(const GainTheory& t) {
  if (t.found == t.rule) return {};
  std::vector<GainCause> out;
  if (apart(t.planes_found, t.planes_rule) < kClearPlanes)
    out.push_back(GainCause::no_matter);
  else if (t.planes_found > t.planes_rule)
    out.push_back(GainCause::other_aims);
  if (t.edge_turn > 0.0 && t.edge_found < t.edge_rule * (1.0 - kClearPlanes)) out.push_back(GainCause::rounded_edges);
  const double found = t.found.curvature_m;
  if (t.height_mean_m > 0.0 && std::abs(found - t.height_mean_m) < std::abs(found - t.rule.curvature_m) &&
      apart(found, t.height_mean_m) < kSameStep)
    out.push_back(GainCause::depth);
  if (apart(step_at(t.found, t.curvature_mean_per_m), step_at(t.rule, t.curvature_mean_per_m)) < kSameStep)
    out.push_back(GainCause::same_step);
  if (out.empty()) out.push_back(GainCause::other);
  return out;
}

template <class... Values>
std::string theory_line(const char* pattern, Values... values) {
  std::array<char, 240> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return std::string("  ") + text.data() + "\n";
}

std::string cause_text(const GainTheory& t, GainCause cause) {
  const char* name = kGainCauses[static_cast<std::size_t>(cause)].data();
  switch (cause) {
    case GainCause::no_matter:
      return theory_line("%s: %.3f planes a tick with the found gains, %.3f with the rule's", name, t.planes_found,
                         t.planes_rule);
    case GainCause::other_aims:
      return theory_line("%s: the found gains take more planes, %.3f a tick against %.3f", name, t.planes_found,
                         t.planes_rule);
    case GainCause::rounded_edges:
      return theory_line(
          "%s: %.0f %% of the ticks are on ground with h/r %.2g, where the rule leaves %.2f of the error a plane "
          "and the found gains %.2f",
          name, 100.0 * t.grounds_found.share(tangent::Ground::tight), t.edge_turn, t.edge_rule, t.edge_found);
    case GainCause::depth:
      return theory_line("%s: h is %.4g m in the mean, the reach less the penetration", name, t.height_mean_m);
    case GainCause::same_step:
      return theory_line("%s: at the mean curvature, %.3g per m, the factor is %.3f found and %.3f by the rule", name,
                         t.curvature_mean_per_m, step_at(t.found, t.curvature_mean_per_m),
                         step_at(t.rule, t.curvature_mean_per_m));
    case GainCause::other:
      break;
  }
  return theory_line("%s: %.3f planes a tick with the found gains, %.3f with the rule's", name, t.planes_found,
                     t.planes_rule);
}

}  // namespace

std::optional<GainTheory> gain_theory(const std::shared_ptr<const ContactScene>& scene, const Preset& found,
                                      std::span<const TickInput> motion, const std::function<bool()>& stop) {
  GainTheory out;
  out.found = gains_of(found.solver);
  out.rule = {1.0, found.finger.reach_m(), 0.0};
  const Preset mine = with_paper_gains(found, out.found), by_rule = with_paper_gains(found, out.rule);
  Contacts contacts(*scene, mine, by_rule);
  const auto planes = run_paper(scene, mine, motion, stop, out.grounds_found, &contacts);
  const auto rule = planes ? run_paper(scene, by_rule, motion, stop, out.grounds_rule, nullptr) : std::nullopt;
  if (!rule) return std::nullopt;
  out.planes_found = *planes;
  out.planes_rule = *rule;
  contacts.put_into(out);
  out.causes = causes_of(out);
  return out;
}

std::string gain_theory_text(const GainTheory& t) {
  std::string out = "Theory beside what was found (`paper`):\n";
  out += theory_line("G_k %.4g m found, the finger's reach %.4g m by the rule; G_o %.3g and 1; G_d %.3g per m and 0",
                     t.found.curvature_m, t.rule.curvature_m, t.found.overall, t.found.distance_per_m);
  for (const tangent::Ground ground : kGrounds)
    if (t.grounds_found.share(ground) > 0.0)
      out += theory_line("%-7s %5.1f %% of the ticks: %.3f planes found, %.3f by the rule", to_string(ground),
                         100.0 * t.grounds_found.share(ground), t.grounds_found.mean_iterations(ground),
                         t.grounds_rule.mean_iterations(ground));
  if (t.edge_turn > 0.0) {
    out += theory_line(
        "tight ground: h/r %.3g, so (h/r)/(2 + h/r) = %.3f is left a plane by theory; %.3f by the rule, %.3f found",
        t.edge_turn, t.edge_theory, t.edge_rule, t.edge_found);
    if (apart(t.edge_theory, t.edge_rule) > kSameContraction)
      out += theory_line(
          "  that is theory for an edge, straight along its length; here the smaller curvature is %.2f of the "
          "larger, which one factor suits better",
          t.edge_roundness);
  }
  if (t.causes.empty()) return out + "  The found gains are the rule's.\n";
  out += "  They part because:\n";
  for (const GainCause cause : t.causes) out += "  " + cause_text(t, cause);
  return out;
}

}  // namespace tangent::sweep
