#include "workbench/experiment/trial_events.h"

#include "core/base/text.h"
#include "core/io/atomic_file.h"

#include <algorithm>
#include <array>

namespace tangent::experiment {
namespace {

constexpr std::array<std::string_view, 11> kEventNames{"started",  "trial", "note",   "paused", "resumed", "ended",
                                                       "training", "guide", "second", "rest",   "armed"};

// The first three are those of BIDS.
constexpr std::array<ColumnMeaning, 6> kEventColumns{{
    {"onset", "s", "since the participant's first start of the program, pauses between starts included"},
    {"duration", "s", "not known when the row is written: until the next event"},
    {"trial_type", "",
     "started, ended: the program; training, guide, trial (the first of two, or an object), second (of two), rest: "
     "what "
     "was shown; armed: the first force; paused, resumed: why, and that it went on; note: of the operator"},
    {"trial", "", "as in the table of answers, from 0"},
    {"text", "", "the stimulus, the reason, or the note; \"simulated\" in it: of a simulated device"},
    {"check", "", "checksum of this row and the one before"},
}};

std::string name_of(TrialEvent event) { return std::string(kEventNames[static_cast<std::size_t>(event)]); }

std::string identity_of(const Enrolment& enrolment) { return enrolment.identity() + "|events"; }

bool is_trial(const Fields& row) { return row[2] == name_of(TrialEvent::trial); }

}  // namespace

Result<TrialEvents> TrialEvents::open(const std::filesystem::path& rows, const Enrolment& enrolment) {
  const std::filesystem::path path = events_path(rows);
  Fields columns;
  for (const ColumnMeaning& column : kEventColumns)
    if (column.name != "check") columns.emplace_back(column.name);
  Result<RowFile> file = RowFile::open(path, columns, identity_of(enrolment));
  if (!file) return tl::unexpected(file.error());
  const auto head = read_sidecar_head(sidecar_path(rows));
  if (!head) return tl::unexpected(head.error());
  if (Status ok = check_not_cut(path, file->count(), head->least().events); !ok) return tl::unexpected(ok.error());
  const std::filesystem::path meaning = std::filesystem::path(path).replace_extension(".json");
  if (Status ok = write_file_atomic(meaning, columns_json(kEventColumns)); !ok) return tl::unexpected(ok.error());
  TrialEvents out(std::move(*file));
  for (const Fields& row : out.file_.rows()) {
    const int trial = std::atoi(row[3].c_str());
    const double onset_s = parse_finite_double(row[0]).value_or(0.0);
    if (is_trial(row)) ++out.begun_[trial];
    if (row[2] == name_of(TrialEvent::started)) out.starts_.emplace_back(trial, onset_s);
    out.newest_s_ = std::max(out.newest_s_, onset_s);
  }
  return out;
}

Status TrialEvents::add(double onset_s, int trial, TrialEvent event, const std::string& text) {
  std::string line;
  for (const char c : text) line += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  const double at_s = std::max(onset_s, newest_s_);
  std::string onset;
  append_double(onset, at_s);
  const Status ok = file_.add({onset, "n/a", name_of(event), std::to_string(trial), line.empty() ? "n/a" : line});
  if (!ok) return ok;
  newest_s_ = at_s;
  if (event == TrialEvent::trial) ++begun_[trial];
  return {};
}

Result<std::string> events_complaint(const std::filesystem::path& rows, const Sidecar& sidecar, std::size_t answers) {
  const std::filesystem::path path = events_path(rows);
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    return sidecar.least.events == 0 ? std::string() : path.string() + ": is missing";
  const auto read = read_rows(path, identity_of(sidecar.enrolment));
  if (!read) return tl::unexpected(read.error());
  if (!read->complaint.empty()) return read->complaint;
  if (Status ok = check_not_cut(path, read->rows.size(), sidecar.least.events); !ok)
    return ok.error().where + ": " + ok.error().what;
  int newest = 0;
  for (const Fields& row : read->rows)
    if (is_trial(row)) newest = std::max(newest, std::atoi(row[3].c_str()));
  if (static_cast<std::size_t>(newest) <= answers) return std::string();
  return rows.string() + ": was cut at its end: trial " + std::to_string(newest) + " was begun after " +
         std::to_string(answers) + (answers == 1 ? " answer" : " answers");
}

std::optional<double> TrialEvents::started_before_s(int trial) const {
  std::optional<double> out;
  for (const auto& [under_way, onset_s] : starts_)
    if (under_way < trial) out = onset_s;
  return out;
}

int TrialEvents::begun(int trial) const {
  const auto found = begun_.find(trial);
  return found == begun_.end() ? 0 : found->second;
}

}  // namespace tangent::experiment
