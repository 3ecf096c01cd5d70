// The page's part on comparisons.
#include "workbench/analysis/analysis_figures.h"
#include "workbench/analysis/analysis_page.h"
#include "workbench/analysis/page_table.h"
#include "workbench/experiment/paper_results.h"

#include <cmath>

namespace tangent::analysis {
namespace {

const experiment::PaperThreshold* paper_of(const std::string& condition) {
  for (const auto& row : experiment::kPaperThresholds)
    if (row.condition == condition) return &row;
  return nullptr;
}

void add_number(PageTable::Row& row, double value, int decimals) { row.number(value, decimals_text(value, decimals)); }

PageTable conditions_table(const ComparisonResults& results, bool simulated) {
  PageTable table(
      "conditions",
      "Thresholds over participants, with 95 % intervals, which are cut at the fewest segments that are shown; in "
      "degrees between neighbouring segments.",
      simulated);
  table.column("Condition", "condition").column("Participants", "participants");
  table.column("Segments", "segments").column("from", "segments_low").column("to", "segments_high");
  table.column("Degrees", "degrees").column("from", "degrees_low").column("to", "degrees_high");
  table.column("Paper, segments", "paper_segments").column("\xC2\xB1", "paper_half");
  for (const ConditionResult& c : results.conditions) {
    const experiment::PaperThreshold* paper = paper_of(c.condition);
    const bool some = !c.thresholds.empty();
    const double none = std::nan("");
    PageTable::Row row = table.row();
    row.text(c.condition).count(c.thresholds.size());
    add_number(row, some ? c.segments.mean : none, 1);
    add_number(row, some ? c.low : none, 1);
    add_number(row, some ? c.high : none, 1);
    add_number(row, some ? c.degrees : none, 2);
    add_number(row, some ? c.degrees_low : none, 2);
    add_number(row, some ? c.degrees_high : none, 2);
    add_number(row, paper != nullptr ? paper->segments : none, 1);
    add_number(row, paper != nullptr ? paper->half_interval : none, 2);
  }
  return table;
}

/// How the thresholds were come by. A table of its own: one of both is wider than a page.
PageTable rule_table(const ComparisonResults& results, bool simulated) {
  PageTable table("rule",
                  "Staircases of each condition, where their rule settles, and the spread of the psychometric "
                  "function, with its 95 % interval.",
                  simulated);
  table.column("Condition", "condition").column("Trials each", "trials").column("Not settled", "not_settled");
  table.column("With a warning", "warned").column("Rule over threshold", "rule_bias");
  table.column("Spread", "spread").column("from", "spread_low").column("to", "spread_high");
  for (const ConditionResult& c : results.conditions) {
    PageTable::Row row = table.row();
    row.text(c.condition);
    add_number(row, c.mean_trials, 1);
    row.count(c.not_settled).count(c.warned);
    add_number(row, c.rule_bias, 2);
    add_number(row, c.spread.spread, 2);
    add_number(row, c.spread.low, 2);
    add_number(row, c.spread.high, 2);
  }
  return table;
}

PageTable anova_table(const ComparisonResults& results, bool simulated) {
  PageTable table("anova", "Do conditions differ: analysis of variance of the thresholds in segments.", simulated);
  table.column("Analysis", "analysis").column("F", "f").column("Degrees of freedom", "freedom_between");
  table.column("and", "freedom_error").column("p", "p");
  const auto add = [&](const std::string& name, const std::optional<VarianceAnalysis>& a) {
    if (!a) return;
    table.row()
        .text(name)
        .number(a->f, decimals_text(a->f, 2))
        .number(a->freedom_between, decimals_text(a->freedom_between, 0))
        .number(a->freedom_error, decimals_text(a->freedom_error, 0))
        .number(a->p, probability_text(a->p));
  };
  add("participants as independent (as in the paper)", results.between);
  add("within participants", results.repeated);
  return table;
}

PageTable pairs_table(const ComparisonResults& results, bool simulated) {
  PageTable table("pairs",
                  "Pairs of conditions by Tukey's test, in segments; the intervals hold for all pairs at once.",
                  simulated);
  table.column("First", "first").column("Second", "second").column("Difference", "difference");
  table.column("from", "low").column("to", "high").column("p", "p").column("Different", "different");
  for (const TukeyPair& pair : results.pairs)
    table.row()
        .text(results.conditions[pair.first].condition)
        .text(results.conditions[pair.second].condition)
        .number(pair.difference, decimals_text(pair.difference, 1))
        .number(pair.low, decimals_text(pair.low, 1))
        .number(pair.high, decimals_text(pair.high, 1))
        .number(pair.p, probability_text(pair.p))
        .text(pair.p < 0.05 ? "yes" : "no");
  return table;
}

PageTable order_table(const ComparisonResults& results, bool simulated) {
  PageTable table("order", "Order of the conditions and the paper's (Table 2).", simulated);
  table.column("Participants", "participants").column("Tau", "tau").column("from", "low").column("to", "high");
  const OrderAgreement& order = *results.order;
  table.row()
      .count(order.participants)
      .number(order.tau, decimals_text(order.tau, 2))
      .number(order.low, decimals_text(order.low, 2))
      .number(order.high, decimals_text(order.high, 2));
  return table;
}

std::string joined_warnings(const StaircaseResult& one) {
  std::string out;
  for (const std::string& warning : one.warnings) out += (out.empty() ? "" : "; ") + warning;
  return out;
}

PageTable staircases_table(const ComparisonResults& results, bool simulated) {
  PageTable table(
      "staircases",
      "Each staircase: the rule's mean of reversals, and the threshold by all psychometric functions that its "
      "answers allow, with its interval.",
      simulated);
  table.column("Participant", "participant").column("Condition", "condition").column("Trials", "trials");
  table.column("Rule, segments", "rule_segments").column("Fit, segments", "fit_segments").column("from", "fit_low");
  table.column("to", "fit_high").column("Rule over threshold", "rule_bias").column("Warning", "warning");
  for (const StaircaseResult& one : results.staircases) {
    const double rule = one.segments.value_or(std::nan(""));
    table.row()
        .text(one.participant)
        .text(one.condition)
        .count(static_cast<std::uint64_t>(one.trials))
        .number(rule, one.segments ? decimals_text(rule, 1) : "not settled")
        .number(one.fitted.segments, decimals_text(one.fitted.segments, 1))
        .number(one.fitted.low, decimals_text(one.fitted.low, 1))
        .number(one.fitted.high, decimals_text(one.fitted.high, 1))
        .number(one.rule_bias, decimals_text(one.rule_bias, 2))
        .text(joined_warnings(one));
  }
  return table;
}

/// Staircases of the participant that they begin with.
std::vector<std::span<const StaircaseResult>> by_participant(const std::vector<StaircaseResult>& all) {
  std::vector<std::span<const StaircaseResult>> out;
  for (std::size_t first = 0; first < all.size();) {
    std::size_t end = first;
    while (end < all.size() && all[end].participant == all[first].participant) ++end;
    out.emplace_back(all.data() + first, end - first);
    first = end;
  }
  return out;
}

}  // namespace

Result<Section> comparison_section(const ComparisonResults& results, bool simulated) {
  Section out;
  out.html = element("h2", "Which of two is smooth");
  if (Status ok =
          add_figure(out, thresholds_figure(results, simulated),
                     "Thresholds in segments, mean and 95 % interval, beside the paper's Tables 1 and 2.", simulated);
      !ok)
    return tl::unexpected(ok.error());
  if (const auto warned = staircases_with_warnings(results); warned > 0)
    out.html += element("p",
                        escaped(std::to_string(warned) + " of " + counted(results.staircases.size(), "staircase") +
                                " have a warning: what is no threshold is in the means all the same. The last table "
                                "says which, and why."),
                        "class=\"bad\"");
  std::vector<PageTable> tables{conditions_table(results, simulated), rule_table(results, simulated)};
  if (results.order) tables.push_back(order_table(results, simulated));
  tables.push_back(anova_table(results, simulated));
  tables.push_back(pairs_table(results, simulated));
  tables.push_back(staircases_table(results, simulated));
  for (const PageTable& table : tables) {
    out.html += table.html();
    out.tables.emplace_back(table.name(), table.csv());
  }
  out.html += paragraph(
      "Rule over threshold: how far the rule's mean of reversals lies off in simulated staircases with these "
      "thresholds and the condition's spread; steps and start decide that. Spread: of the psychometric function in "
      "the logarithm of segments, all participants together, between 0.05 and 2; a single staircase does not tell "
      "it. Tau: Kendall's, of the mean thresholds and Table 2, 1 the same order, 0 none in common, with its 95 % "
      "interval over participants drawn again. The paper's own angles: its means are 51.68 / (n - 1) degrees, "
      "the ends of its intervals 51.68 / n.");
  out.html += element("h3", "Staircases");
  int number = 1;
  for (const auto& one : by_participant(results.staircases)) {
    const std::string name = "staircases" + std::to_string(number++);
    const std::string caption =
        "Participant " + one.front().participant + ": filled right, open wrong, squares reversals.";
    if (Status ok = add_figure(out, staircases_figure(one, name, simulated), caption, simulated); !ok)
      return tl::unexpected(ok.error());
  }
  return out;
}

}  // namespace tangent::analysis
