#include "workbench/experiment/run_simulated.h"

#include "core/base/fnv.h"
#include "workbench/experiment/order.h"
#include "workbench/experiment/simulated_group.h"
#include "workbench/experiment/trial_setup.h"

#include <optional>

namespace tangent::experiment {
namespace {

/// Thrown out of a run that is asked to stop, or can't be written.
struct Stopped {};

class Recorder {
 public:
  Recorder(RowFile& file, const Enrolment& enrolment, const std::function<bool()>& stop, SimulatedOutcome& out)
      : file_(file), mark_(enrolment.mark), stop_(stop), out_(out) {
    origin_.protocol = enrolment.protocol_digest;
    origin_.program = program_digest();
  }
  template <class Row>
  void add(const Row& row) {
    status_ = file_.add(fields_of(mark_, row, origin_));
    if (!status_) throw Stopped{};
    ++out_.made;
    out_.stopped = stop_ && stop_();
    if (out_.stopped) throw Stopped{};
  }
  const Status& status() const { return status_; }

 private:
  RowFile& file_;
  const RunMark& mark_;
  RowOrigin origin_;
  const std::function<bool()>& stop_;
  SimulatedOutcome& out_;
  Status status_;
};

Status compare(const Protocol& protocol, const Enrolment& enrolment, std::uint64_t number, const RowFile& file,
               Recorder& recorder) {
  const auto rows = comparison_rows(file);
  if (!rows) return tl::unexpected(rows.error());
  auto run = ComparisonRun::start(protocol, number, enrolment.seed, *rows);
  if (!run) return tl::unexpected(run.error());
  // Each start counts from 0.
  const double before_s = rows->empty() ? 0.0 : rows->back().began_s + rows->back().first_s + rows->back().second_s;
  const auto add = [&](ComparisonRow row) {
    row.began_s += before_s;
    recorder.add(row);
  };
  if (enrolment.mark.simulated == kSimulatedKinds[1]) {
    auto arcs = arcs_to_feel(protocol);
    if (!arcs) return tl::unexpected(arcs.error());
    FeelingComparer participant(std::move(*arcs), *protocol.discrimination(), feeling_hand(number, enrolment.seed),
                                enrolment.seed);
    return take_part(*run, participant, enrolment.seed, add);
  }
  take_part(*run, comparer_like_the_papers(protocol, number, enrolment.seed), enrolment.seed, add);
  return {};
}

Status name_objects(const Protocol& protocol, const Enrolment& enrolment, std::uint64_t number, const RowFile& file,
                    Recorder& recorder) {
  auto rows = naming_rows(file);
  if (!rows) return tl::unexpected(rows.error());
  const Identification& design = *protocol.identification();
  const KnownNamer known = namer_like_the_papers(design);
  std::optional<FeelingNamer> feeling;
  if (enrolment.mark.simulated == kSimulatedKinds[1] &&
      rows->size() < object_trials(design, number, enrolment.seed).size()) {
    auto made = FeelingNamer::make(protocol, feeling_hand(number, enrolment.seed), enrolment.seed);
    if (!made) return tl::unexpected(made.error());
    feeling.emplace(std::move(*made));
  }
  for (;;) {
    auto run = NamingRun::start(protocol, number, enrolment.seed, *rows);
    if (!run) return tl::unexpected(run.error());
    if (run->all_done()) return {};
    const double before_s = rows->empty() ? 0.0 : rows->back().began_s + rows->back().since_touch_s;
    const auto add = [&](NamingRow row) {
      row.began_s += before_s;
      recorder.add(row);
      rows->push_back(row);
    };
    if (!feeling)
      take_part(*run, design, known, enrolment.seed, add);
    else if (Status ok = take_part(*run, design, *feeling, enrolment.seed, add); !ok)
      return ok;
  }
}

}  // namespace

std::uint64_t default_seed(const std::string& participant, const std::string& protocol_digest) {
  return Fnv().add(participant).add("|").add(protocol_digest).value();
}

Result<SimulatedOutcome> run_simulated(const std::filesystem::path& folder, const Protocol& protocol,
                                       const std::string& protocol_text, const Enrolment& enrolment,
                                       const std::function<bool()>& stop) {
  const auto number = participant_number(enrolment.mark.participant);
  if (!number)
    return fail("\"" + enrolment.mark.participant + "\" ends with no number, which the orders go by", "--participant",
                "write 7, or P07");
  Result<RowFile> file = enrol(folder, protocol, protocol_text, enrolment);
  if (!file) return tl::unexpected(file.error());
  SimulatedOutcome out;
  out.rows = rows_path(folder, enrolment.mark.participant, protocol);
  out.before = file->rows().size();
  const std::filesystem::path sidecar = sidecar_path(out.rows);
  if (Status ok = note_start(sidecar, utc_now_s(), {file->count(), 0}); !ok) return tl::unexpected(ok.error());
  Recorder recorder(*file, enrolment, stop, out);
  try {
    const Status ok = protocol.discrimination() ? compare(protocol, enrolment, *number, *file, recorder)
                                                : name_objects(protocol, enrolment, *number, *file, recorder);
    if (!ok) return tl::unexpected(ok.error());
  } catch (const Stopped&) {
    if (!recorder.status()) return tl::unexpected(recorder.status().error());
  }
  if (Status ok = note_end(sidecar, utc_now_s(), {file->count(), 0}); !ok) return tl::unexpected(ok.error());
  return out;
}

}  // namespace tangent::experiment
