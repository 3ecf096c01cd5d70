#include "workbench/gui/platform/experiment_window.h"

#include "workbench/gui/experiment/experiment_keys.h"
#include "workbench/gui/experiment/operator_screen.h"
#include "workbench/gui/experiment/participant_screen.h"
#include "workbench/gui/experiment/practice_scene.h"
#include "workbench/gui/experiment/trial_screens.h"
#include "workbench/gui/platform/experiment_monitor.h"
#include "workbench/gui/platform/ui_drawing.h"
#include "workbench/gui/platform/window_input.h"

#include <epoxy/gl.h>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace tangent {
namespace {

using experiment::TrialKey;
using experiment::TrialSession;

constexpr double kExperimentFrame_s = 1.0 / 60.0;

/// All monitors as rectangles, and the one that the operator's window opens on: the primary.
std::vector<MonitorPlace> monitor_places(GLFWmonitor** monitors, int count) {
  std::vector<MonitorPlace> places;
  for (int i = 0; i < count; ++i) {
    MonitorPlace place;
    glfwGetMonitorPos(monitors[i], &place.x, &place.y);
    if (const GLFWvidmode* mode = glfwGetVideoMode(monitors[i])) {
      place.width = mode->width;
      place.height = mode->height;
    }
    places.push_back(place);
  }
  return places;
}

WindowHandle open_operators() {
  hint_opengl();
  WindowHandle window(glfwCreateWindow(1280, 720, "Experiment: operator", nullptr, nullptr));
  if (window) glfwSetWindowSizeLimits(window.get(), 900, 500, GLFW_DONT_CARE, GLFW_DONT_CARE);
  return window;
}

struct ParticipantWindow {
  WindowHandle window;
  bool own_monitor = false;
};

/// Full screen on a second monitor, and stays there while the operator types; else a window like any other.
ParticipantWindow open_participants() {
  hint_opengl();
  int count = 0;
  GLFWmonitor** const monitors = glfwGetMonitors(&count);
  const std::vector<MonitorPlace> places = monitor_places(monitors, count);
  const auto other = participant_monitor(places, 0);  // GLFW's first is the primary
  glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
  ParticipantWindow out;
  out.own_monitor = other.has_value();
  GLFWmonitor* const monitor = other ? monitors[*other] : nullptr;
  const int width = other ? places[*other].width : 960, height = other ? places[*other].height : 600;
  out.window.reset(glfwCreateWindow(width, height, "Experiment", monitor, nullptr));
  return out;
}

/// One of the two windows: GL and ImGui contexts of its own, its events, what it shows.
class ExperimentPane {
 public:
  ExperimentPane(WindowHandle window, bool wait_for_screen, std::function<void(int)> pressed)
      : window_(std::move(window)),
        imgui_(window_.get()),
        input_(window_.get(), {std::move(pressed), [this] { drawing_.forget(); }, nullptr}) {
    glfwSwapInterval(wait_for_screen ? 1 : 0);
  }

  GLFWwindow* window() const { return window_.get(); }
  void make_current() const { imgui_.make_current(); }
  WindowSize size() const { return window_size(window_.get()); }
  bool focused() const { return glfwGetWindowAttrib(window_.get(), GLFW_FOCUSED) == GLFW_TRUE; }
  void forget() { drawing_.forget(); }

  /// `build`: from ImGui::NewFrame to ImGui::Render. The contexts are current.
  template <class Build>
  void draw(const ImVec4& ground, std::uint64_t picture, const Build& build) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    input_.queue().apply(ImGui::GetIO());
    build();
    if (!drawing_.changed(*ImGui::GetDrawData(), picture)) return;
    const WindowSize now = size();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, now.width_px, now.height_px);
    UiDrawing::draw(*ImGui::GetDrawData(), ground);
    glfwSwapBuffers(window_.get());
  }

 private:
  WindowHandle window_;
  ImGuiOnWindow imgui_;
  UiDrawing drawing_;
  WindowInput input_;
};

class ExperimentLoop {
 public:
  ExperimentLoop(TrialSession& trials, experiment::SoundFollower& sound, ExperimentFacts facts, Theme theme,
                 ParticipantWindow participants, WindowHandle operators)
      : trials_(trials),
        sound_(sound),
        facts_(std::move(facts)),
        theme_(theme),
        participant_(std::move(participants.window), false, [this](int key) { answer(key); }),
        operator_(std::move(operators), true, [this](int key) {
          if (key == GLFW_KEY_ESCAPE) trials_.press(TrialKey::stop);
        }) {
    panel_.set_covered(!participants.own_monitor);
  }

  ~ExperimentLoop() {
    participant_.make_current();
    practice_.reset();
  }
  ExperimentLoop(const ExperimentLoop&) = delete;
  ExperimentLoop& operator=(const ExperimentLoop&) = delete;

  Status init() {
    participant_.make_current();
    return practice_->init();
  }

  void run(const std::function<bool()>& should_stop) {
    glfwFocusWindow(participant_.window());
    for (double due = glfwGetTime(); !over_ && !(should_stop && should_stop());) {
      glfwPollEvents();
      for (double wait = due - glfwGetTime(); wait > 0.0; wait = due - glfwGetTime()) glfwWaitEventsTimeout(wait);
      due = std::max(due + kExperimentFrame_s, glfwGetTime());
      trials_.poll();
      feeder_.take(trials_.session());
      sound_.follow(trials_);
      draw_participants();
      draw_operators();
      glfwSetWindowShouldClose(participant_.window(), GLFW_FALSE);  // the operator's window ends it
      over_ = over_ || glfwWindowShouldClose(operator_.window()) == GLFW_TRUE;
    }
  }

 private:
  void answer(int glfw_key) {
    const auto key = experiment_key(glfw_key);
    if (!key) return;
    if (key->kind == PressedKey::Kind::stop) return trials_.press(TrialKey::stop);
    if (key->kind == PressedKey::Kind::enter) return trials_.press(TrialKey::enter);
    if (key->kind == PressedKey::Kind::lift) return trials_.press(TrialKey::lift);
    choice_ = key->digit;
    trials_.press(experiment::digit_key(key->digit));
  }

  void draw_participants() {
    const experiment::ParticipantView view = trials_.participant();
    if (view.phase != experiment::Phase::second || view.trial != chosen_in_) choice_ = 0;
    chosen_in_ = view.trial;
    const ParticipantScreen screen = participant_screen(view, facts_.protocol, choice_);
    participant_.make_current();
    const WindowSize size = participant_.size();
    if (size.width < 1.0f || size.height < 1.0f) return;
    if (size.width != large_for_.x || size.height != large_for_.y) {
      std::vector<std::string> missing;
      large_ = load_large_fonts(size.width, size.height, missing);
      large_for_ = {size.width, size.height};
      upload_fonts_again();
      participant_.forget();
    }
    PracticePicture scene;
    if (screen.show_scene) scene = practice_->draw(trials_.session(), {size.width, size.height}, theme_);
    participant_.draw({0, 0, 0, 1}, practice_->version(), [&] {
      ImGui::NewFrame();
      draw_participant_screen(screen, large_, {size.width, size.height}, is_dark(theme_), scene);
      ImGui::Render();
    });
  }

  void draw_operators() {
    OperatorScreen screen = operator_screen(trials_, facts_, feeder_.trace());
    screen.participant_has_keys = participant_.focused();
    if (screen.paused && !sound_.lost().empty()) screen.fault = sound_.lost();
    operator_.make_current();
    const WindowSize size = operator_.size();
    if (size.width < 1.0f || size.height < 1.0f) return;
    if (panel_.prepare(theme_, size.scale)) {
      upload_fonts_again();
      operator_.forget();
    }
    OperatorWishes wishes;
    operator_.draw(panel_.ground(), 0, [&] {
      wishes = panel_.frame(screen, {size.width, size.height}, glfwGetTime());
    });
    take(wishes);
  }

  void take(const OperatorWishes& wishes) {
    if (!wishes.note.empty()) trials_.note(wishes.note);
    if (wishes.resume) trials_.press(TrialKey::resume);
    if (wishes.resume || wishes.give_keys) glfwFocusWindow(participant_.window());
    if (wishes.stop) trials_.press(TrialKey::stop);
    over_ = over_ || wishes.end;
  }

  TrialSession& trials_;
  experiment::SoundFollower& sound_;
  ExperimentFacts facts_;
  Theme theme_;
  ExperimentPane participant_;
  std::optional<PracticeScene> practice_{std::in_place};  // its GL objects are the participant's
  ExperimentPane operator_;
  OperatorPanel panel_;
  TraceFeeder feeder_;
  LargeFonts large_;
  ImVec2 large_for_{0.0f, 0.0f};
  int choice_ = 0, chosen_in_ = 0;
  bool over_ = false;
};

}  // namespace

Result<ExperimentOutcome> run_experiment_window(ExperimentWindowOptions options,
                                                const std::function<bool()>& should_stop) {
  const GlfwLibrary library;
  if (!library.ready())
    return fail("no display: " + glfw_reason(), "experiment", "leave --window out: keys then come from the terminal");
  WindowHandle operators = open_operators();
  ParticipantWindow participants = open_participants();
  if (!operators || !participants.window)
    return fail("no window with OpenGL 3.3: " + glfw_reason(), "experiment",
                "update the graphics driver, or use software GL (LIBGL_ALWAYS_SOFTWARE=1)");
  auto sound = experiment::SoundFollower::open(options.sound, options.sound_device);
  if (!sound) return tl::unexpected(sound.error());
  options.trials.sound = sound->text();
  const experiment::RunMark& mark = options.trials.enrolment.mark;
  ExperimentFacts facts{options.trials.protocol, mark.participant, mark.simulated == "no" ? "" : mark.simulated,
                        options.trials.sound, mark.pilot};
  auto trials = TrialSession::start(std::move(options.trials));
  if (!trials) return tl::unexpected(trials.error());
  {
    ExperimentLoop loop(**trials, *sound, std::move(facts), options.theme, std::move(participants),
                        std::move(operators));
    if (Status ready = loop.init(); !ready) return tl::unexpected(ready.error());
    loop.run(should_stop);
  }
  const ExperimentOutcome outcome{(*trials)->rows(), (*trials)->answers(), (*trials)->complete()};
  if (Status ended = (*trials)->end(); !ended) return tl::unexpected(ended.error());
  return outcome;
}

}  // namespace tangent
