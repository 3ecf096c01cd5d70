// What a group's names of objects say (Doxon et al. 5.3.5, 5.3.6): confusions, accuracy, times, and what shading,
// tactile feedback and experience change.
#pragma once

#include "workbench/analysis/confusion.h"
#include "workbench/analysis/group_tests.h"
#include "workbench/analysis/load_answers.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tangent::analysis {

/// Part of the trials: all, or those of one kind.
struct NamingPart {
  std::string name;  ///< "all", "shaded", "unshaded", "tactile", "force alone", "experienced", "inexperienced"
  ConfusionMatrix matrix{0};
  std::size_t participants = 0;
  RatioInterval accuracy;         ///< Wilson's interval
  MeanInterval of_participants;   ///< mean and interval of their accuracies
  MeanInterval information_bits;  ///< corrected
};

/// Times of one object.
struct ObjectTimes {
  std::string object;
  std::uint64_t right = 0;
  MeanInterval response_s;    ///< from the first touch, right answers alone
  MeanInterval touching_s;    ///< of these, touching
  MeanInterval share_shaded;  ///< share of the time in contact, all answers
  MeanInterval share_unshaded;
};

struct NamingTest {
  std::string question;   ///< "response time of right answers: shaded less unshaded"
  std::string values;     ///< what is compared: "participants, paired", "answers as independent, as in the paper"
  std::size_t count = 0;  ///< of these, both sides together; pairs count once
  std::string unit;
  std::optional<TTest> test;
};

struct NamingResults {
  std::vector<std::string> objects;
  std::vector<NamingPart> parts;
  std::vector<ObjectTimes> times;
  /// Student's t over participants' means, paired where each has both; and, as the paper's, over cells or answers as if
  /// these were independent.
  std::vector<NamingTest> tests;
};

/// `experienced`: by participant; empty: not known.
NamingResults naming_results(const std::vector<ParticipantAnswers<experiment::NamingRow>>& participants,
                             const std::map<std::string, bool>& experienced = {});

}  // namespace tangent::analysis
