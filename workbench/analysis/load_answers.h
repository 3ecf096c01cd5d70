// Answers of one participant or many, from the files that `workbench experiment` wrote.
#pragma once

#include "workbench/experiment/experiment_folder.h"

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace tangent::analysis {

template <class Row>
struct ParticipantAnswers {
  std::filesystem::path file;
  experiment::Enrolment enrolment;
  experiment::Protocol protocol;
  std::vector<Row> rows;
  const std::string& name() const { return enrolment.mark.participant; }
};

/// "1 answer", "3 answers".
inline std::string counted(std::size_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

struct Answers {
  std::vector<ParticipantAnswers<experiment::ComparisonRow>> comparisons;
  std::vector<ParticipantAnswers<experiment::NamingRow>> namings;
  std::vector<std::string> left_out;  ///< pilot runs, and what was edited where that was allowed: file and why
  std::set<std::string> found;        ///< participants, those of left out files included
  bool simulated = false;             ///< some of it is
};

struct LoadOptions {
  bool pilots = false;  ///< analyse pilot runs, too
  bool edited = false;  ///< analyse files whose checksums do not hold, and say so
};

/// Files (.tsv), or folders in which all of them are taken; participants in the order of their numbers. Fails on the
/// first that can't be read, whose checksums do not hold, or whose rows are not what its protocol and seed show; and on
/// a mixture of protocols of one kind, of people and simulated participants, or of two kinds of these.
Result<Answers> load_answers(std::span<const std::filesystem::path> data, const LoadOptions& options);

}  // namespace tangent::analysis
