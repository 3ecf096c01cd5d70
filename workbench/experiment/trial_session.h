// An experiment with a person: a participant's run (trial_run.h) on a session with devices. It puts each stimulus under
// the finger, tells from the ticks when it is touched, draws the finger to the start, writes the answers, and pauses on
// whatever goes wrong; the trial that was cut is then begun again, and its row says so.
//
// How stimuli are replaced: stimulus_changer.h. All force goes through the safety gate.
//
//   auto trials = TrialSession::start(std::move(options));
//   every frame: trials->press(key); trials->poll(); draw participant() and operator_view()
//   (*trials)->end();
//
// One thread (the GUI's) owns it and makes all calls.
#pragma once

#include "workbench/experiment/stimulus_changer.h"
#include "workbench/experiment/trial_events.h"
#include "workbench/experiment/trial_recorder.h"
#include "workbench/experiment/trial_run.h"
#include "workbench/session/session.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tangent::experiment {

enum class TrialKey : std::uint8_t {
  enter,
  digit_1,
  digit_2,
  digit_3,
  digit_4,
  digit_5,
  digit_6,
  digit_7,
  digit_8,
  digit_9,
  stop,    ///< no force, at once, and a pause
  resume,  ///< arms and goes on
  quit,    ///< ends this start; the same command goes on later
  lift,    ///< raises a simulated finger, or lowers it; nothing on a real device
};
/// Of a digit, 1 to 9; the key of Enter for others.
TrialKey digit_key(int digit);

/// What the participant may know. Nothing of it tells one stimulus from another, but in training and practice.
struct ParticipantView {
  std::string prompt;             ///< what to do now
  std::string hint;               ///< why a key was not taken; empty: it was
  bool show_scene = false;        ///< training and practice: `TrialSession::session().scene()` may be drawn
  bool show_finger = false;       ///< on the way to the start, the finger may be drawn as a dot
  Vec3 finger_from_start_m{0.0};  ///< then; world: x away from the person, y left, z up
  int trial = 0, of = 0;          ///< from 1; `of` is a guess where answers decide
  Phase phase = Phase::training;
  std::uint64_t cues = 0;  ///< sounds so far: a change is a ding
};

struct OperatorView {
  std::string stimulus, condition;
  std::string what_is_next;
  Progress progress;
  bool touching = false;
  bool paused = false;
  std::string fault;                            ///< why it is paused, and what to do; empty: it is not
  std::vector<std::string> notes;               ///< events and the operator's notes, oldest first
  std::vector<std::pair<int, bool>> staircase;  ///< of this condition, trial by trial: segments, answered right
};

struct TrialOptions {
  Protocol protocol;
  std::string protocol_text;  ///< the protocol's file, kept beside the data
  std::filesystem::path out;
  Enrolment enrolment;           ///< of a person; at a simulated force device it is marked as simulated
  SessionOptions session;        ///< devices, servo; arm_on_start is not used; without a placement, the stimuli's
  std::string sound = "none";    ///< what plays noise and cues, for the rows
  bool record = false;           ///< every tick of each trial
  bool same_day = false;         ///< a session may follow the one before sooner than the protocol says
  bool without_timeout = false;  ///< a person was told of Session::without_timeout and said yes
  std::function<std::int64_t()> utc_s = utc_now_s;  ///< the date, seconds since 1970
};

class TrialSession {
 public:
  /// Builds the stimuli, opens the devices, enrols the participant. Simulated devices arm by themselves; real ones
  /// begin with a pause: a person presses `resume`. Fails on what TrialRun::start and Session::create fail on, without
  /// a force device, and where a condition needs a display that is missing.
  static Result<std::unique_ptr<TrialSession>> start(TrialOptions options);
  /// With devices of one's own.
  static Result<std::unique_ptr<TrialSession>> start(TrialOptions options, DeviceSet devices);
  ~TrialSession();
  TrialSession(const TrialSession&) = delete;
  TrialSession& operator=(const TrialSession&) = delete;

  void press(TrialKey key);
  /// Of the operator, kept with its time.
  void note(const std::string& text);
  /// At display rate: takes the new ticks, changes stimuli, writes rows.
  void poll();
  ParticipantView participant() const;
  OperatorView operator_view() const;
  bool finished() const { return ended_ || run_.finished(); }
  bool complete() const { return run_.finished(); }       ///< this session of it; else it was ended before
  std::string outcome() const { return run_.outcome(); }  ///< in words
  const Session& session() const { return *session_; }
  Session& session() { return *session_; }  ///< for its clutch, placement and, unthreaded, `advance`
  const std::filesystem::path& rows() const { return run_.rows(); }
  int answers() const { return run_.progress().done; }

  /// Stops the force, closes the files. Fails where something could not be written, or a device does not return.
  Status end();

 private:
  enum class Stage : std::uint8_t { paused, arming, running };
  TrialSession(TrialOptions options, Stimuli stimuli, TrialRun run, TrialEvents events,
               std::unique_ptr<Session> session);
  static Result<std::unique_ptr<TrialSession>> make(TrialOptions options, DeviceSet* devices);
  Status begin();
  void take_records();
  void take(const ServoRecord& record);
  void watch_arming(const ServoRecord& record);
  bool watch_faults(const ServoRecord& record);
  void advance(Key key, int digit);
  void show();
  Status tell_interval();
  bool begin_trial();
  void lead_hand();
  void watch_start();
  void pause(const std::string& why);
  void resume();
  Status log(TrialEvent event, const std::string& text);
  Status log_arming();
  double clock_s() const { return any_ ? last_.tick.input.t_s : 0.0; }  ///< of this start
  RowOrigin origin() const;
  Status check_devices_are_there() const;

  TrialOptions options_;
  TrialRun run_;
  TrialEvents events_;
  std::unique_ptr<Session> session_;
  StimulusChanger changer_;
  TrialRecorder recorder_;

  Stage stage_ = Stage::paused;
  bool ended_ = false, closed_ = false;
  std::string fault_;
  std::vector<std::string> notes_;
  ServoRecord last_;              ///< the newest tick that was taken
  bool any_ = false;              ///< there was one
  std::uint64_t armed_from_ = 0;  ///< ticks before this one say nothing of the wish to arm
  Moment moment_;                 ///< the last

  std::optional<Phase> told_;  ///< interval that the events know of; none: the next one is new
  int begun_ = -1;             ///< trial that the events know of in this start
  bool ever_armed_ = false;
  std::optional<bool> devices_there_;  ///< before the first force; none: not known yet
  double paused_at_s_ = 0.0;
  double begun_after_s_ = 0.0;  ///< the participant's first start
};

}  // namespace tangent::experiment
