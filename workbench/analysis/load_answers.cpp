#include "workbench/analysis/load_answers.h"

#include "workbench/experiment/order.h"
#include "workbench/experiment/trial_events.h"

#include <algorithm>

namespace tangent::analysis {
namespace {

namespace fs = std::filesystem;
using experiment::ComparisonRow;
using experiment::NamingRow;

constexpr std::string_view kEnding = "_beh.tsv";

Result<std::vector<fs::path>> files_in(std::span<const fs::path> data) {
  std::vector<fs::path> out;
  for (const fs::path& path : data) {
    std::error_code error;
    if (!fs::exists(path, error))
      return fail("is not there", path.string(), "give the folder that `workbench experiment --out` was given");
    if (!fs::is_directory(path, error)) {
      out.push_back(path);
      continue;
    }
    const std::size_t before = out.size();
    for (auto at = fs::recursive_directory_iterator(path, error); !error && at != fs::recursive_directory_iterator();
         at.increment(error))
      if (at->path().string().ends_with(kEnding)) out.push_back(at->path());
    if (error) return fail("can't be looked through: " + error.message(), path.string());
    if (out.size() == before)
      return fail("has no answers in it (no *" + std::string(kEnding) + ")", path.string(),
                  "give the folder that `workbench experiment --out` was given");
    std::sort(out.begin() + static_cast<std::ptrdiff_t>(before), out.end());
  }
  return out;
}

Result<std::pair<experiment::RunMark, ComparisonRow>> row_from(const experiment::Fields& columns,
                                                               const experiment::Fields& fields, ComparisonRow*) {
  return experiment::comparison_row(columns, fields);
}
Result<std::pair<experiment::RunMark, NamingRow>> row_from(const experiment::Fields& columns,
                                                           const experiment::Fields& fields, NamingRow*) {
  return experiment::naming_row(columns, fields);
}

bool over(const experiment::ComparisonRun& run) { return run.finished(); }
bool over(const experiment::NamingRun& run) { return run.all_done(); }

/// Whether the rows are what the protocol shows a participant of that seed; whether they are all, as a note.
template <class Run, class Row>
Status check_rows(const ParticipantAnswers<Row>& answers, std::vector<std::string>& notes) {
  const auto number = experiment::participant_number(answers.name());
  const auto run = Run::start(answers.protocol, number.value_or(0), answers.enrolment.seed, answers.rows);
  if (run && !over(*run))
    notes.push_back(answers.file.string() + ": not finished, " + counted(answers.rows.size(), "answer"));
  if (run) return {};
  return fail(run.error().what, answers.file.string() + " " + run.error().where, run.error().remedy);
}

/// Of rows that are analysed though they were changed: values that no protocol has, by line.
Status check_values(const ParticipantAnswers<ComparisonRow>& answers) {
  for (std::size_t i = 0; i < answers.rows.size(); ++i)
    if (const int segments = answers.rows[i].segments; segments < 1 || segments > 1'000'000)
      return fail(std::to_string(segments) + " is no number of segments",
                  answers.file.string() + ":" + std::to_string(i + 2), "use the file as it was written");
  return {};
}
Status check_values(const ParticipantAnswers<NamingRow>& answers) {
  const auto& names = answers.protocol.identification()->objects;
  const auto known = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (std::size_t i = 0; i < answers.rows.size(); ++i) {
    const NamingRow& row = answers.rows[i];
    if (known(row.object) && known(row.answer)) continue;
    return fail("\"" + (known(row.object) ? row.answer : row.object) + "\" is no object of the protocol",
                answers.file.string() + ":" + std::to_string(i + 2), "use the file as it was written");
  }
  return {};
}

template <class Row>
std::string kind_of(const ParticipantAnswers<Row>& answers) {
  const std::string& simulated = answers.enrolment.mark.simulated;
  if (simulated == "device") return "somebody at a simulated device (device)";
  return simulated == "no" ? "a person" : "a simulated participant (" + simulated + ")";
}

/// By number, as a person would: P2 before P10.
template <class Row>
void sort_by_number(std::vector<ParticipantAnswers<Row>>& all) {
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return experiment::participant_number(a.name()).value_or(0) < experiment::participant_number(b.name()).value_or(0);
  });
}

template <class Run>
Status add_file(const fs::path& file, const experiment::Sidecar& sidecar, const experiment::ReadRows& read, bool edited,
                std::vector<ParticipantAnswers<typename Run::Row>>& out, std::vector<std::string>& notes) {
  using Row = typename Run::Row;
  ParticipantAnswers<Row> answers{file, sidecar.enrolment, sidecar.protocol, {}};
  for (std::size_t i = 0; i < read.rows.size(); ++i) {
    auto row = row_from(read.columns, read.rows[i], static_cast<Row*>(nullptr));
    if (!row) return fail(row.error().what, file.string() + ":" + std::to_string(i + 2) + " " + row.error().where);
    answers.rows.push_back(std::move(row->second));
  }
  if (Status ok = check_values(answers); !ok) return ok;
  if (!edited)
    if (Status ok = check_rows<Run>(answers, notes); !ok) return ok;
  for (const ParticipantAnswers<Row>& other : out) {
    if (other.name() == answers.name())
      return fail("participant " + answers.name() + " is in " + other.file.string() + ", too", file.string(),
                  "give each participant's answers once");
    if (other.enrolment.protocol_digest != answers.enrolment.protocol_digest)
      return fail("belongs to another protocol than " + other.file.string(), file.string(),
                  "analyse answers to one protocol at a time");
    if (other.enrolment.mark.simulated != answers.enrolment.mark.simulated)
      return fail(
          kind_of(answers) + " and " + kind_of(other) + " can't be analysed together (" + other.file.string() + ")",
          file.string(), "analyse them apart");
  }
  out.push_back(std::move(answers));
  return {};
}

/// Why a participant's files are not as they were written; empty: they are.
Result<std::string> complaint_of(const fs::path& file, const experiment::Sidecar& sidecar,
                                 const experiment::ReadRows& read) {
  if (!read.complaint.empty()) return read.complaint;
  if (Status ok = experiment::check_not_cut(file, read.rows.size(), sidecar.least.answers); !ok)
    return ok.error().where + ": " + ok.error().what;
  return experiment::events_complaint(file, sidecar, read.rows.size());
}

Status load_file(const fs::path& file, const LoadOptions& options, Answers& out) {
  const auto sidecar = experiment::read_sidecar(file);
  if (!sidecar) return tl::unexpected(sidecar.error());
  const auto read = experiment::read_rows(file, sidecar->enrolment.identity());
  if (!read) return tl::unexpected(read.error());
  out.found.insert(sidecar->enrolment.mark.participant);
  if (sidecar->enrolment.mark.pilot && !options.pilots) {
    out.left_out.push_back(file.string() + ": a pilot run");
    return {};
  }
  const auto complaint = complaint_of(file, *sidecar, *read);
  if (!complaint) return tl::unexpected(complaint.error());
  const bool edited = !complaint->empty();
  if (edited && !options.edited)
    return fail("was changed by hand", *complaint, "use the files as they were written, or say --edited");
  if (edited) out.left_out.push_back("analysed though it was changed by hand: " + *complaint);
  if (read->rows.empty()) {
    out.left_out.push_back(file.string() + ": no answers in it");
    return {};
  }
  out.simulated = out.simulated || sidecar->enrolment.mark.simulated != "no";
  return sidecar->protocol.discrimination()
             ? add_file<experiment::ComparisonRun>(file, *sidecar, *read, edited, out.comparisons, out.left_out)
             : add_file<experiment::NamingRun>(file, *sidecar, *read, edited, out.namings, out.left_out);
}

}  // namespace

Result<Answers> load_answers(std::span<const fs::path> data, const LoadOptions& options) {
  const Result<std::vector<fs::path>> files = files_in(data);
  if (!files) return tl::unexpected(files.error());
  Answers out;
  for (const fs::path& file : *files)
    if (Status ok = load_file(file, options, out); !ok) return tl::unexpected(ok.error());
  sort_by_number(out.comparisons);
  sort_by_number(out.namings);
  if (out.comparisons.empty() && out.namings.empty())
    return fail("there is nothing to analyse: only pilot runs, or no answers", data.front().string(), "say --pilots");
  return out;
}

}  // namespace tangent::analysis
