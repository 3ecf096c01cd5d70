#include "workbench/experiment/trial_run.h"

namespace tangent::experiment {
namespace {

Result<std::variant<ComparisonRun, NamingRun>> run_after(const RowFile& file, const Protocol& protocol,
                                                         std::uint64_t number, std::uint64_t seed) {
  if (protocol.discrimination()) {
    const auto rows = comparison_rows(file);
    if (!rows) return tl::unexpected(rows.error());
    auto run = ComparisonRun::start(protocol, number, seed, *rows);
    if (!run) return tl::unexpected(run.error());
    return std::move(*run);
  }
  const auto rows = naming_rows(file);
  if (!rows) return tl::unexpected(rows.error());
  auto run = NamingRun::start(protocol, number, seed, *rows);
  if (!run) return tl::unexpected(run.error());
  return std::move(*run);
}

}  // namespace

Result<TrialRun> TrialRun::start(const std::filesystem::path& folder, const Protocol& protocol,
                                 const std::string& protocol_text, const Enrolment& enrolment, std::int64_t now_utc_s) {
  const std::string& name = enrolment.mark.participant;
  if (Status ok = check_participant(name); !ok) return tl::unexpected(ok.error());
  const auto number = participant_number(name);
  if (!number)
    return fail("\"" + name + "\" ends with no number, which the orders go by", "--participant", "write 7, or P07");
  Result<RowFile> file = enrol(folder, protocol, protocol_text, enrolment, now_utc_s);
  if (!file) return tl::unexpected(file.error());
  const std::filesystem::path rows = rows_path(folder, name, protocol);
  auto run = run_after(*file, protocol, *number, enrolment.seed);
  if (!run) return fail(run.error().what, rows.string() + " " + run.error().where, run.error().remedy);
  TrialRun out(std::move(*run), std::move(*file), enrolment.mark, rows);
  if (out.finished())
    return fail("participant " + name + " has answered everything already", rows.string(),
                "take another participant or another folder");
  return out;
}

const Shown& TrialRun::shown() const {
  return std::visit([](const auto& run) -> const Shown& { return run.shown(); }, run_);
}
Progress TrialRun::progress() const {
  return std::visit([](const auto& run) { return run.progress(); }, run_);
}
int TrialRun::trial() const {
  return std::visit([](const auto& run) { return run.trial(); }, run_);
}
std::string TrialRun::what_is_next() const {
  return std::visit([](const auto& run) { return run.what_is_next(); }, run_);
}
std::vector<std::pair<int, bool>> TrialRun::staircase() const {
  const auto* comparison = std::get_if<ComparisonRun>(&run_);
  return comparison != nullptr ? comparison->answers() : std::vector<std::pair<int, bool>>{};
}

bool TrialRun::begins_session() const {
  const auto* naming = std::get_if<NamingRun>(&run_);
  return naming != nullptr && naming->begins_session();
}

std::string TrialRun::outcome() const {
  if (!finished()) return "ended before its end";
  const auto* naming = std::get_if<NamingRun>(&run_);
  return naming != nullptr && !naming->all_done() ? naming->session_text() + " complete" : "complete";
}

Status TrialRun::advance(const Moment& moment, const RowOrigin& origin) {
  if (owed_) return settle();
  std::visit(
      [&](auto& run) {
        if (auto row = run.advance(moment)) {
          row->began_s += begun_after_s_;
          owed_ = fields_of(mark_, *row, origin);
        }
      },
      run_);
  return settle();
}

Status TrialRun::settle() {
  if (!owed_) return {};
  const Status ok = file_.add(*owed_);
  if (ok) owed_.reset();
  return ok;
}

void TrialRun::repeat(double t_s) {
  std::visit([t_s](auto& run) { run.repeat(t_s); }, run_);
}

}  // namespace tangent::experiment
