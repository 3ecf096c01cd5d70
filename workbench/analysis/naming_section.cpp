// The page's part on named objects.
#include "workbench/analysis/analysis_figures.h"
#include "workbench/analysis/analysis_page.h"
#include "workbench/analysis/page_table.h"

#include <cmath>
#include <cstdio>

namespace tangent::analysis {
namespace {

PageTable parts_table(const NamingResults& results, bool simulated) {
  PageTable table("parts", "Accuracy and information by part of the trials, with 95 % intervals.", simulated);
  table.column("Trials", "part").column("Participants", "participants").column("Answers", "answers");
  table.column("Right, %", "accuracy_percent").column("from", "accuracy_low").column("to", "accuracy_high");
  table.column("Mean of participants, %", "participants_percent").column("\xC2\xB1", "participants_half");
  table.column("Information, bits", "information_bits").column("\xC2\xB1", "information_half");
  for (const NamingPart& part : results.parts) {
    const auto percent = [](double share) { return decimals_text(100.0 * share, 1); };
    table.row()
        .text(part.name)
        .count(part.participants)
        .count(part.matrix.total())
        .number(100.0 * part.accuracy.ratio, percent(part.accuracy.ratio))
        .number(100.0 * part.accuracy.low, percent(part.accuracy.low))
        .number(100.0 * part.accuracy.high, percent(part.accuracy.high))
        .number(100.0 * part.of_participants.mean, percent(part.of_participants.mean))
        .number(100.0 * part.of_participants.half, percent(part.of_participants.half))
        .number(part.information_bits.mean, decimals_text(part.information_bits.mean, 2))
        .number(part.information_bits.half, decimals_text(part.information_bits.half, 2));
  }
  return table;
}

PageTable confusion_table(const NamingResults& results, const NamingPart& part, bool simulated) {
  std::string name = "confusion-" + part.name;
  for (char& c : name)
    if (c == ' ') c = '-';
  PageTable table(name, "Percent of answers (columns) to each object (rows), " + part.name + ".", simulated);
  table.column("Shown", "shown");
  for (const std::string& object : results.objects) table.column(object, object + "_percent");
  table.column("Answers", "answers");
  for (std::size_t i = 0; i < results.objects.size(); ++i) {
    PageTable::Row row = table.row();
    row.text(results.objects[i]);
    for (std::size_t j = 0; j < results.objects.size(); ++j) {
      const double percent = 100.0 * part.matrix.share(i, j);
      row.number(percent, decimals_text(percent, 1));
    }
    row.count(part.matrix.shown(i));
  }
  return table;
}

PageTable times_table(const NamingResults& results, bool simulated) {
  PageTable table("response-times",
                  "Times of right answers, and share of the time in contact, means with 95 % intervals.", simulated);
  table.column("Object", "object")
      .column("Right", "right")
      .column("Response, s", "response_s")
      .column("\xC2\xB1", "response_half_s");
  table.column("Touching, s", "touching_s").column("\xC2\xB1", "touching_half_s");
  table.column("In contact, shaded, %", "shaded_percent").column("\xC2\xB1", "shaded_half");
  table.column("unshaded, %", "unshaded_percent").column("\xC2\xB1", "unshaded_half");
  for (const ObjectTimes& t : results.times) {
    PageTable::Row row = table.row();
    row.text(t.object).count(t.right);
    const auto add = [&](const MeanInterval& value, double scale, int decimals) {
      row.number(scale * value.mean, decimals_text(scale * value.mean, decimals));
      row.number(scale * value.half, decimals_text(scale * value.half, decimals));
    };
    add(t.response_s, 1.0, 2);
    add(t.touching_s, 1.0, 2);
    add(t.share_shaded, 100.0, 1);
    add(t.share_unshaded, 100.0, 1);
  }
  return table;
}

PageTable tests_table(const NamingResults& results, bool simulated) {
  PageTable table(
      "tests",
      "Student's t: difference of means, first less second. Answers of one participant are not independent: "
      "the tests over participants hold, the paper's are beside them to be compared with its own.",
      simulated);
  table.column("Question", "question")
      .column("Over", "over")
      .column("n", "n")
      .column("Difference", "difference")
      .column("from", "low")
      .column("to", "high");
  table.column("t", "t").column("Degrees of freedom", "freedom").column("p", "p");
  for (const NamingTest& test : results.tests) {
    PageTable::Row row = table.row();
    row.text(test.question).text(test.values).count(test.count);
    if (!test.test) {
      for (int i = 0; i < 6; ++i) row.number(std::nan(""), i == 0 ? "can't be tested" : "");
      continue;
    }
    const TTest& t = *test.test;
    const std::string unit = test.unit.empty() ? "" : " " + test.unit;
    row.number(t.difference, decimals_text(t.difference, 3) + unit).number(t.low, decimals_text(t.low, 3));
    row.number(t.high, decimals_text(t.high, 3)).number(t.t, decimals_text(t.t, 2));
    row.number(t.freedom, decimals_text(t.freedom, 0)).number(t.p, probability_text(t.p));
  }
  return table;
}

}  // namespace

Result<Section> naming_section(const NamingResults& results, bool simulated) {
  Section out;
  out.html = element("h2", "Which object is it");
  const auto add = [&](Figure figure, const char* caption) {
    return add_figure(out, std::move(figure), caption, simulated);
  };
  if (Status ok = add(accuracy_figure(results, simulated),
                      "Right answers to each object, with 95 % intervals, beside the paper's Table 3.");
      !ok)
    return tl::unexpected(ok.error());
  if (Status ok =
          add(times_figure(results, simulated),
              "Time from the first touch to the answer, right answers alone, and how much of it the finger touched.");
      !ok)
    return tl::unexpected(ok.error());
  if (Status ok =
          add(contact_figure(results, simulated), "Share of that time in which the finger touched, all answers.");
      !ok)
    return tl::unexpected(ok.error());
  std::vector<PageTable> tables{parts_table(results, simulated)};
  for (const NamingPart& part : results.parts) tables.push_back(confusion_table(results, part, simulated));
  tables.push_back(times_table(results, simulated));
  tables.push_back(tests_table(results, simulated));
  for (const PageTable& table : tables) {
    out.html += table.html();
    out.tables.emplace_back(table.name(), table.csv());
  }
  out.html += paragraph(
      "Information: what the answers tell of the object, of log2 of the number of objects; less what chance adds with "
      "so few "
      "answers (Miller 1955), its interval by leaving out one participant after the other. The paper's table holds "
      "1.82 of "
      "2.81 bits, by our own count.");
  return out;
}

}  // namespace tangent::analysis
