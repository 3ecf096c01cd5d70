#include "workbench/experiment/trial_events.h"

#include "core/base/text.h"

#include <array>

namespace tangent::experiment {
namespace {

constexpr std::array<std::string_view, 6> kEventNames{"started", "trial", "note", "paused", "resumed", "ended"};

std::string name_of(TrialEvent event) { return std::string(kEventNames[static_cast<std::size_t>(event)]); }

}  // namespace

Result<TrialEvents> TrialEvents::open(const std::filesystem::path& rows, const Enrolment& enrolment) {
  const Fields columns{"onset", "duration", "trial_type", "trial", "text"};  // the first three are those of BIDS
  Result<RowFile> file = RowFile::open(events_path(rows), columns, enrolment.identity() + "|events");
  if (!file) return tl::unexpected(file.error());
  TrialEvents out(std::move(*file));
  for (const Fields& row : out.file_.rows())
    if (row[2] == name_of(TrialEvent::trial)) ++out.begun_[std::atoi(row[3].c_str())];
  return out;
}

Status TrialEvents::add(double t_s, int trial, TrialEvent event, const std::string& text) {
  std::string line;
  for (const char c : text) line += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  std::string onset;
  append_double(onset, t_s);
  const Status ok = file_.add({onset, "n/a", name_of(event), std::to_string(trial), line.empty() ? "n/a" : line});
  if (ok && event == TrialEvent::trial) ++begun_[trial];
  return ok;
}

int TrialEvents::begun(int trial) const {
  const auto found = begun_.find(trial);
  return found == begun_.end() ? 0 : found->second;
}

}  // namespace tangent::experiment
