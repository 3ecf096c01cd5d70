#include "workbench/gui/platform/experiment_shots.h"

#include "core/io/input_file.h"
#include "workbench/experiment/order.h"
#include "workbench/gui/experiment/operator_screen.h"
#include "workbench/gui/experiment/participant_screen.h"
#include "workbench/gui/experiment/practice_scene.h"
#include "workbench/gui/experiment/trial_screens.h"
#include "workbench/gui/model/shipped_presets.h"
#include "workbench/gui/platform/offscreen.h"
#include "workbench/session/own_folder.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

namespace tangent {
namespace {

using experiment::Phase;
using experiment::TrialKey;

constexpr int kTicksAtOnce = 20;
constexpr int kFeelTicks = 900, kRaiseTicks = 400, kLowerTicks = 1500, kWaitTicks = 6000;
constexpr int kGuideTicks = 120;  // the finger is still on its way
constexpr int kAnswersShown = 14;
constexpr int kNamesShown = 20;                   // of the second of eight runs
constexpr std::array kWrongAnswers{3, 4, 7, 10};  // of those
constexpr int kScreenFrames = 4;                  // in which ImGui lays out

/// A run of a shipped protocol on simulated devices, tick by tick, without thread and clock.
class StagedExperiment {
 public:
  static Result<std::unique_ptr<StagedExperiment>> begin(const std::string& name) {
    const std::filesystem::path file = shipped_presets() / "experiments" / (name + ".toml");
    const Result<std::string> text = read_input_file(file, std::size_t{1} << 20);
    if (!text) return tl::unexpected(text.error());
    Result<experiment::Protocol> protocol = experiment::parse_protocol(*text, file);
    if (!protocol) return tl::unexpected(protocol.error());
    Result<OwnFolder> folder = OwnFolder::make();
    if (!folder) return tl::unexpected(folder.error());
    experiment::TrialOptions options;
    options.protocol = *protocol;
    options.protocol_text = *text;
    options.out = folder->path();
    options.enrolment.mark.participant = "P7";
    options.enrolment.mark.pilot = true;
    options.enrolment.seed = kSeed;
    options.enrolment.protocol_digest = experiment::protocol_digest(*protocol);
    options.session.threaded = false;
    options.session.history_s = 12.0;
    auto trials = experiment::TrialSession::start(std::move(options));
    if (!trials) return tl::unexpected(trials.error());
    ExperimentFacts facts{std::move(*protocol), "P7", "", "none", true};
    return std::unique_ptr<StagedExperiment>(
        new StagedExperiment(std::move(*folder), std::move(facts), std::move(*trials)));
  }

  experiment::TrialSession& trials() { return *trials_; }
  const ExperimentFacts& facts() const { return facts_; }
  const ForceTrace& trace() const { return feeder_.trace(); }
  Phase phase() const { return trials_->participant().phase; }

  /// Goes over what is there.
  void feel() {
    int felt = 0;
    for (int ticks = 0; felt < kFeelTicks && ticks < kWaitTicks; ticks += kTicksAtOnce) {
      run(kTicksAtOnce);
      felt += trials_->operator_view().touching ? kTicksAtOnce : 0;
      if (felt == 0 && ticks % kLowerTicks == kLowerTicks - kTicksAtOnce) trials_->press(TrialKey::lift);  // lowers it
    }
  }
  /// Raised, and the keys.
  void raise_and_press(std::initializer_list<TrialKey> keys) {
    trials_->press(TrialKey::lift);
    run(kRaiseTicks);
    for (const TrialKey key : keys) trials_->press(key);
  }
  /// Comparisons until so many are answered.
  void answer(int count) {
    for (int steps = 0; trials_->answers() < count && steps < 4 * count + 8; ++steps) {
      if (phase() == Phase::second) {
        feel();
        raise_and_press({answer_key(), TrialKey::enter});
      } else {
        feel();
        raise_and_press({TrialKey::enter});
      }
    }
  }
  /// Practice, and objects until so many are named, each by its own key.
  void name(int count) {
    feel();
    raise_and_press({TrialKey::enter});
    for (wait_for(Phase::explore); trials_->answers() < count && phase() == Phase::explore; wait_for(Phase::explore)) {
      feel();
      trials_->press(experiment::digit_key(name_key()));
    }
  }
  void wait_for(Phase wanted) {
    for (int ticks = 0; phase() != wanted && ticks < kWaitTicks; ticks += kTicksAtOnce) run(kTicksAtOnce);
  }
  int name_key() const {
    const experiment::Identification& design = *facts_.protocol.identification();
    const auto number = experiment::participant_number(facts_.participant).value_or(0);
    const auto trials = experiment::object_trials(design, number, kSeed);
    return 1 + static_cast<int>(trials[static_cast<std::size_t>(trials_->answers())].object);
  }
  TrialKey answer_key() const {
    const int trial = trials_->answers();
    const auto number = experiment::participant_number(facts_.participant).value_or(0);
    const auto order = experiment::latin_row(facts_.protocol.discrimination()->conditions.size(), number);
    const bool first = experiment::reference_first(kSeed, order.front(), static_cast<std::size_t>(trial));
    const bool wrong = std::find(kWrongAnswers.begin(), kWrongAnswers.end(), trial) != kWrongAnswers.end();
    return first != wrong ? TrialKey::digit_1 : TrialKey::digit_2;
  }
  void run(int ticks) {
    for (; ticks > 0; ticks -= kTicksAtOnce) {
      trials_->session().advance(kTicksAtOnce);
      trials_->poll();
      feeder_.take(trials_->session());
    }
  }

 private:
  static constexpr std::uint64_t kSeed = 7;
  StagedExperiment(OwnFolder folder, ExperimentFacts facts, std::unique_ptr<experiment::TrialSession> trials)
      : folder_(std::move(folder)), facts_(std::move(facts)), trials_(std::move(trials)) {}

  OwnFolder folder_;
  ExperimentFacts facts_;
  TraceFeeder feeder_;
  std::unique_ptr<experiment::TrialSession> trials_;
};

struct ExperimentView {
  const char* name;
  const char* shows;
  const char* protocol;
  bool of_operator;
  Phase phase;    ///< that is shown
  int named = 0;  ///< objects before it
};
constexpr std::array<ExperimentView, 6> kExperimentViews{
    {{"experiment-operator", "an experiment's screen for the operator, half way through a staircase", "discrimination",
      true, Phase::first},
     {"experiment-participant", "the participant's at the same time: no scene", "discrimination", false, Phase::second},
     {"experiment-naming", "the participant's where objects are named: no scene", "identification", false,
      Phase::explore},
     {"experiment-guide",
      "the participant's on the way to the start: the finger is drawn to it, nothing else is in view", "identification",
      false, Phase::guide},
     {"experiment-naming-operator", "the operator's where objects are named, in the second run", "identification", true,
      Phase::explore, kNamesShown},
     {"experiment-practice", "the participant's in practice, with the object in view", "identification", false,
      Phase::training}}};

/// To the view's place in its protocol.
void go_to(StagedExperiment& staged, const ExperimentView& view) {
  if (view.phase == Phase::first || view.phase == Phase::second) {
    staged.answer(kAnswersShown);
    staged.trials().note("headphones put right");
  }
  if (view.phase == Phase::second) {
    staged.feel();
    staged.raise_and_press({TrialKey::enter});
  }
  if (view.phase == Phase::explore) staged.name(view.named);
  staged.feel();
  if (view.phase != Phase::guide) return;
  staged.raise_and_press({TrialKey::enter});
  staged.run(kGuideTicks);
}

Image draw_operator(OffscreenScreen& offscreen, StagedExperiment& staged, const ShotRequest& request, Theme theme) {
  OperatorScreen screen = operator_screen(staged.trials(), staged.facts(), staged.trace());
  screen.data = "data/sub-P7/beh/" + std::filesystem::path(screen.data).filename().string();  // not its own folder
  OperatorPanel panel;
  const ImVec2 size{static_cast<float>(request.width_px), static_cast<float>(request.height_px)};
  for (int i = 0; i < kScreenFrames; ++i) {
    ImGui::GetIO().DeltaTime = 1.0f / 60.0f;
    if (panel.prepare(theme, static_cast<float>(request.scale.value_or(1.0)))) offscreen.upload_fonts();
    offscreen.frame([&] { panel.frame(screen, size, i / 60.0); }, panel.ground());
  }
  return offscreen.picture();
}

Result<Image> draw_participant(OffscreenScreen& offscreen, StagedExperiment& staged, const ShotRequest& request,
                               Theme theme) {
  const ImVec2 size{static_cast<float>(request.width_px), static_cast<float>(request.height_px)};
  const experiment::ParticipantView view = staged.trials().participant();
  const ParticipantScreen screen = participant_screen(view, staged.facts().protocol, 0);
  PracticeScene practice;
  if (Status ready = practice.init(); !ready) return tl::unexpected(ready.error());
  PracticePicture scene;
  if (screen.show_scene) {
    practice.draw(staged.trials().session(), size, theme);
    practice.wait();
    scene = practice.draw(staged.trials().session(), size, theme);
  }
  std::vector<std::string> missing;
  const LargeFonts fonts = load_large_fonts(size.x, size.y, missing);
  offscreen.upload_fonts();
  ImGui::GetIO().DeltaTime = 1.0f / 60.0f;
  offscreen.frame([&] {
    ImGui::NewFrame();
    draw_participant_screen(screen, fonts, size, is_dark(theme), scene);
    ImGui::Render();
  });
  return offscreen.picture();
}

}  // namespace

const std::vector<ShotView>& experiment_shot_views() {
  static const std::vector<ShotView> kNamed = [] {
    std::vector<ShotView> views;
    for (const ExperimentView& view : kExperimentViews) views.push_back({view.name, view.shows, ShotTakes::nothing});
    return views;
  }();
  return kNamed;
}

Result<Shot> take_experiment_shot(const ShotRequest& request) {
  const ExperimentView& view = *std::find_if(kExperimentViews.begin(), kExperimentViews.end(),
                                             [&](const ExperimentView& v) { return v.name == request.view; });
  Result<std::unique_ptr<OffscreenScreen>> offscreen = OffscreenScreen::open(request.width_px, request.height_px);
  if (!offscreen) return tl::unexpected(offscreen.error());
  auto staged = StagedExperiment::begin(view.protocol);
  if (!staged) return tl::unexpected(staged.error());
  go_to(**staged, view);
  if ((*staged)->phase() != view.phase) return fail("the simulated run did not come to this view", view.name);
  const Theme theme = request.theme.value_or(Theme::dark);
  Result<Image> image = view.of_operator ? draw_operator(**offscreen, **staged, request, theme)
                                         : draw_participant(**offscreen, **staged, request, theme);
  if (!image) return tl::unexpected(image.error());
  FileOrigin origin;
  origin.command = shot_command(request, request.scale.value_or(1.0), theme);
  return Shot{std::move(*image), std::move(origin)};
}

}  // namespace tangent
