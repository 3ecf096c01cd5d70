#include "workbench/analysis/naming_results.h"

#include <algorithm>
#include <functional>
#include <optional>

namespace tangent::analysis {
namespace {

using experiment::NamingRow;
using Namer = ParticipantAnswers<NamingRow>;
using Take = std::function<bool(const Namer&, const NamingRow&)>;

std::size_t index_of(const std::vector<std::string>& objects, const std::string& name) {
  return static_cast<std::size_t>(std::find(objects.begin(), objects.end(), name) - objects.begin());
}

/// Accuracy of each participant in what is taken; those without such a trial are left out.
std::vector<double> accuracies(const std::vector<Namer>& participants, const Take& take) {
  std::vector<double> out;
  for (const Namer& participant : participants) {
    double right = 0.0, all = 0.0;
    for (const NamingRow& row : participant.rows) {
      if (!take(participant, row)) continue;
      all += 1.0;
      right += row.right;
    }
    if (all > 0.0) out.push_back(right / all);
  }
  return out;
}

NamingPart part_of(const std::string& name, const std::vector<std::string>& objects,
                   const std::vector<Namer>& participants, const Take& take) {
  NamingPart out;
  out.name = name;
  out.matrix = ConfusionMatrix(objects.size());
  std::vector<ConfusionMatrix> each;
  for (const Namer& participant : participants) {
    ConfusionMatrix own(objects.size());
    for (const NamingRow& row : participant.rows)
      if (take(participant, row)) own.add(index_of(objects, row.object), index_of(objects, row.answer));
    if (own.total() == 0) continue;
    out.matrix += own;
    each.push_back(std::move(own));
  }
  out.participants = each.size();
  if (each.empty()) return out;
  out.accuracy = share_interval(out.matrix.right(), out.matrix.total());
  out.of_participants = mean_interval(accuracies(participants, take));
  out.information_bits = information_interval(each);
  return out;
}

double share_touching(const NamingRow& row) {
  return row.since_touch_s > 0.0 ? row.touching_s / row.since_touch_s : 0.0;
}

ObjectTimes times_of(const std::string& object, const std::vector<Namer>& participants) {
  std::vector<double> response, touching, shaded, unshaded;
  for (const Namer& participant : participants) {
    for (const NamingRow& row : participant.rows) {
      if (row.object != object) continue;
      (row.shaded ? shaded : unshaded).push_back(share_touching(row));
      if (!row.right) continue;
      response.push_back(row.since_touch_s);
      touching.push_back(row.touching_s);
    }
  }
  return {object,
          response.size(),
          mean_interval(response),
          mean_interval(touching),
          mean_interval(shaded),
          mean_interval(unshaded)};
}

/// A value of each trial that is taken.
std::vector<double> values_of(const std::vector<Namer>& participants, const Take& take,
                              double (*value)(const NamingRow&)) {
  std::vector<double> out;
  for (const Namer& participant : participants)
    for (const NamingRow& row : participant.rows)
      if (take(participant, row)) out.push_back(value(row));
  return out;
}

/// Accuracies of each participant and object, as the paper's 252 values (18 by 14) are.
std::vector<double> cell_accuracies(const std::vector<Namer>& participants, const std::vector<std::string>& objects,
                                    const Take& take) {
  std::vector<double> out;
  for (const std::string& object : objects) {
    const auto of_object = [&](const Namer& p, const NamingRow& row) { return row.object == object && take(p, row); };
    const std::vector<double> values = accuracies(participants, of_object);
    out.insert(out.end(), values.begin(), values.end());
  }
  return out;
}

constexpr const char* kPaired = "participants, paired";
constexpr const char* kApart = "participants";

/// A mean of each participant; none: nothing is taken.
std::vector<std::optional<double>> means_of(const std::vector<Namer>& participants, const Take& take,
                                            double (*value)(const NamingRow&)) {
  std::vector<std::optional<double>> out;
  for (const Namer& participant : participants) {
    double sum = 0.0, count = 0.0;
    for (const NamingRow& row : participant.rows) {
      if (!take(participant, row)) continue;
      sum += value(row);
      count += 1.0;
    }
    out.push_back(count > 0.0 ? std::optional(sum / count) : std::nullopt);
  }
  return out;
}

class Tests {
 public:
  Tests(const std::vector<Namer>& participants, const std::vector<std::string>& objects, NamingResults& out)
      : participants_(participants), objects_(objects), out_(out) {}

  /// `within`: each participant is on both sides.
  void compare(const std::string& what, const Take& a, const Take& b, bool within) {
    within_ = within;
    over_participants("accuracy: " + what, "", a, b, [](const NamingRow& row) { return row.right ? 1.0 : 0.0; });
    as_independent("accuracy: " + what, "", cell_accuracies(participants_, objects_, a),
                   cell_accuracies(participants_, objects_, b), "participants and objects");
    const auto right = [](const Take& take) {
      return [take](const Namer& p, const NamingRow& row) { return row.right && take(p, row); };
    };
    const auto seconds = [](const NamingRow& row) { return row.since_touch_s; };
    over_participants("response time of right answers: " + what, "s", right(a), right(b), seconds);
    as_independent("response time of right answers: " + what, "s", values_of(participants_, right(a), seconds),
                   values_of(participants_, right(b), seconds), "answers");
    over_participants("share of the time in contact: " + what, "", a, b, share_touching);
    as_independent("share of the time in contact: " + what, "", values_of(participants_, a, share_touching),
                   values_of(participants_, b, share_touching), "answers");
  }

 private:
  void over_participants(const std::string& question, const char* unit, const Take& a, const Take& b,
                         double (*value)(const NamingRow&)) {
    const auto of_a = means_of(participants_, a, value), of_b = means_of(participants_, b, value);
    std::vector<double> first, second;
    for (std::size_t i = 0; i < of_a.size(); ++i) {
      if (within_ && !(of_a[i] && of_b[i])) continue;
      if (of_a[i]) first.push_back(*of_a[i]);
      if (of_b[i]) second.push_back(*of_b[i]);
    }
    if (within_)
      out_.tests.push_back({question, kPaired, first.size(), unit, paired_t_test(first, second)});
    else
      out_.tests.push_back({question, kApart, first.size() + second.size(), unit, student_t_test(first, second)});
  }
  void as_independent(const std::string& question, const char* unit, const std::vector<double>& a,
                      const std::vector<double>& b, const std::string& values) {
    out_.tests.push_back(
        {question, values + " as independent, as in the paper", a.size() + b.size(), unit, student_t_test(a, b)});
  }

  const std::vector<Namer>& participants_;
  const std::vector<std::string>& objects_;
  NamingResults& out_;
  bool within_ = false;
};

}  // namespace

NamingResults naming_results(const std::vector<Namer>& participants, const std::map<std::string, bool>& experienced) {
  NamingResults out;
  if (participants.empty()) return out;
  out.objects = participants.front().protocol.identification()->objects;
  const auto is_experienced = [&](bool wanted) -> Take {
    return [&experienced, wanted](const Namer& p, const NamingRow&) {
      const auto at = experienced.find(p.name());
      return at != experienced.end() && at->second == wanted;
    };
  };
  const Take all = [](const Namer&, const NamingRow&) { return true; };
  const Take shaded = [](const Namer&, const NamingRow& row) { return row.shaded; };
  const Take unshaded = [](const Namer&, const NamingRow& row) { return !row.shaded; };
  const Take tactile = [](const Namer&, const NamingRow& row) { return row.tactile; };
  const Take force = [](const Namer&, const NamingRow& row) { return !row.tactile; };
  std::vector<std::pair<std::string, Take>> parts{
      {"all", all}, {"shaded", shaded}, {"unshaded", unshaded}, {"tactile", tactile}, {"force alone", force}};
  if (!experienced.empty()) {
    parts.emplace_back("experienced", is_experienced(true));
    parts.emplace_back("inexperienced", is_experienced(false));
  }
  for (const auto& [name, take] : parts) out.parts.push_back(part_of(name, out.objects, participants, take));
  for (const std::string& object : out.objects) out.times.push_back(times_of(object, participants));
  Tests tests(participants, out.objects, out);
  tests.compare("shaded less unshaded", shaded, unshaded, true);
  tests.compare("tactile less force alone", tactile, force, true);
  if (!experienced.empty())
    tests.compare("experienced less inexperienced", is_experienced(true), is_experienced(false), false);
  return out;
}

}  // namespace tangent::analysis
