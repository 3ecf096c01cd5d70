// How a trial session begins and ends: devices first, without which nobody is enrolled; then the participant's files.
#include "workbench/experiment/trial_session.h"
#include "workbench/experiment/trial_setup.h"

#include <cmath>
#include <cstdio>

namespace tangent::experiment {
namespace {

constexpr const char* kSimulatedDevice = "device";  // of RunMark::simulated: nobody felt anything

/// Fails where a session would begin too soon after the start of the one before. A start that came to no answer of its
/// session is none of the one before.
Status check_days(const TrialRun& run, const TrialEvents& events, const SidecarHead& head, const TrialOptions& options,
                  std::int64_t now_utc_s) {
  if (options.same_day || !run.begins_session()) return {};
  const double wanted = options.protocol.identification()->hours_between_sessions;
  const auto onset_s = events.started_before_s(run.trial());
  const std::int64_t before_utc_s =
      onset_s ? head.starts.front().began_utc_s + static_cast<std::int64_t>(*onset_s) : head.starts.back().began_utc_s;
  const double hours = static_cast<double>(now_utc_s - before_utc_s) / 3600.0;
  if (hours >= wanted) return {};
  if (hours < 0.0)
    return fail("the session before was begun at " + utc_text(before_utc_s) + ", and now it is " + utc_text(now_utc_s),
                run.rows().string(), "put this computer's clock right, or say --same-day, which the events then tell");
  char text[120];
  std::snprintf(text, sizeof text, "the session before was begun %.1f hours ago; the protocol has %g between sessions",
                hours, wanted);
  return fail(text, run.rows().string(), "go on later, or say --same-day, which the events then tell");
}

/// Seconds from a participant's first start to this one. A clock that was put back takes none away.
Result<double> begun_after_s(const TrialRun& run, const TrialEvents& events, const TrialOptions& options,
                             std::int64_t now_utc_s) {
  const auto head = read_sidecar_head(sidecar_path(run.rows()));
  if (!head) return tl::unexpected(head.error());
  if (head->starts.empty()) return 0.0;
  if (Status ok = check_days(run, events, *head, options, now_utc_s); !ok) return tl::unexpected(ok.error());
  return std::max(static_cast<double>(now_utc_s - head->starts.front().began_utc_s), std::ceil(events.newest_s()));
}

}  // namespace

TrialSession::TrialSession(TrialOptions options, Stimuli stimuli, TrialRun run, TrialEvents events,
                           std::unique_ptr<Session> session)
    : options_(std::move(options)),
      run_(std::move(run)),
      events_(std::move(events)),
      session_(std::move(session)),
      changer_(std::move(stimuli), *session_) {}

Result<std::unique_ptr<TrialSession>> TrialSession::start(TrialOptions options) {
  return make(std::move(options), nullptr);
}
Result<std::unique_ptr<TrialSession>> TrialSession::start(TrialOptions options, DeviceSet devices) {
  return make(std::move(options), &devices);
}

// Devices first: without them nobody is enrolled.
Result<std::unique_ptr<TrialSession>> TrialSession::make(TrialOptions options, DeviceSet* devices) {
  options.session.arm_on_start = ArmOnStart::never;
  if (Status ok = check_participant(options.enrolment.mark.participant); !ok) return tl::unexpected(ok.error());
  Result<Stimuli> stimuli = Stimuli::make(options.protocol);
  if (!stimuli) return tl::unexpected(stimuli.error());
  const auto first = stimuli->rendered(kinds_of(options.protocol).front());
  if (!first) return tl::unexpected(first.error());
  // All stimuli of a protocol are placed alike. The device stays where it is in the scene while they change.
  PlaceOptions& place = options.session.place;
  if (!place.fit && !place.offset_m && place.scale == 1.0 && place.rotation == PlaceOptions{}.rotation)
    place = {false, first->placement.scale, first->placement.rotation, first->placement.offset_m};
  auto session = devices != nullptr
                     ? Session::create(first->scene, options.protocol.preset, options.session, std::move(*devices))
                     : Session::create(first->scene, options.protocol.preset, options.session);
  if (!session) return tl::unexpected(session.error());
  if (Status ok = check_conditions(options.protocol, *stimuli, **session); !ok) return tl::unexpected(ok.error());
  std::string& simulated = options.enrolment.mark.simulated;
  if (simulated == "no" && (*session)->force_capabilities()->simulated) simulated = kSimulatedDevice;
  const std::int64_t now_utc_s = options.utc_s();
  auto run = TrialRun::start(options.out, options.protocol, options.protocol_text, options.enrolment, now_utc_s);
  if (!run) return tl::unexpected(run.error());
  auto events = TrialEvents::open(run->rows(), options.enrolment);
  if (!events) return tl::unexpected(events.error());
  const auto after_s = begun_after_s(*run, *events, options, now_utc_s);
  if (!after_s) return tl::unexpected(after_s.error());
  const RowCounts counts{run->answers(), events->count()};
  if (Status ok = note_start(sidecar_path(run->rows()), now_utc_s, counts); !ok) return tl::unexpected(ok.error());
  run->set_begun_after(*after_s);
  auto made = std::unique_ptr<TrialSession>(new TrialSession(std::move(options), std::move(*stimuli), std::move(*run),
                                                             std::move(*events), std::move(*session)));
  made->begun_after_s_ = *after_s;
  if (Status ok = made->begin(); !ok) return tl::unexpected(ok.error());
  return made;
}

Status TrialSession::begin() {
  if (options_.without_timeout) session_->accept_no_timeout();
  const std::string text = device_text(*session_) + "; " + limit_text(options_.protocol, *session_) + "; sound " +
                           options_.sound + "; program " + program_digest() +
                           (options_.same_day ? "; sessions need not lie apart" : "");
  if (Status ok = log(TrialEvent::started, text); !ok) return ok;
  if (Status ok = session_->start(); !ok) return ok;
  fault_ = kNotArmed;
  if (!session_->status().real_devices) return resume(), Status{};
  return log(TrialEvent::paused, kNotArmed);
}

TrialSession::~TrialSession() { static_cast<void>(end()); }

Status TrialSession::end() {
  if (std::exchange(closed_, true)) return {};
  ended_ = true;
  Status out = session_->shut_down();
  const auto also = [&out](const Status& status) {
    if (out && !status) out = status;
  };
  also(recorder_.end());
  also(run_.settle());
  also(log(TrialEvent::ended, run_.outcome()));
  const RowCounts counts{run_.answers(), events_.count()};
  also(note_end(sidecar_path(run_.rows()), options_.utc_s(), counts, changer_.hashes()));
  also(session_->packet_log());
  return out;
}

}  // namespace tangent::experiment
