#include "workbench/gui/model/why_model.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace tangent {

namespace {

bool same_question(const WhyAsked& a, const WhyAsked& b) {
  return a.tick == b.tick && a.input.t_s == b.input.t_s && a.scene == b.scene && a.preset == b.preset &&
         a.input.finger.position == b.input.finger.position;
}

std::shared_ptr<const Why> find_out(const WhyAsked& asked) {
  const auto began = std::chrono::steady_clock::now();
  auto why = std::make_shared<Why>();
  why->asked = asked;
  why->told = explain_tick(asked.scene, asked.preset, asked.input, asked.before);
  why->ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
  return why;
}

}  // namespace

WhyModel::WhyModel(const AppOptions& options, TimeModel& time, PresetModel& presets, ViewModel& view,
                   const SceneModel& scene, MessageLog& messages)
    : time_(time),
      presets_(presets),
      view_(view),
      scene_(scene),
      messages_(messages),
      threaded_(!options.deterministic) {}

WhyModel::~WhyModel() {
  if (!thread_.joinable()) return;
  thread_.request_stop();
  thread_.join();  // before the members that it uses end
}

const Why* WhyModel::of_tick_in_view() {
  take_answer();
  const ServoRecord* record = time_.tick().record();
  const Preset* preset = time_.preset_of_tick();
  const auto scene = time_.scene_of_tick();
  if (!(time_.paused() || time_.placed()) || record == nullptr || preset == nullptr || scene == nullptr) {
    looking_ = false;
    asked_.reset();
    return nullptr;
  }
  WhyAsked now{scene, *preset, record->tick.input, record->tick.kept, record->tick.tick};
  if (!asked_ || !same_question(*asked_, now)) ask(std::move(now));
  return known_ && same_question(known_->asked, *asked_) ? known_.get() : nullptr;
}

void WhyModel::ask(WhyAsked asked) {
  asked_ = std::move(asked);
  if (!threaded_) {
    auto why = std::make_shared<Why>(*find_out(*asked_));
    why->ms = 0.0;
    known_ = std::move(why);
    return;
  }
  looking_ = true;
  if (!thread_.joinable()) thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
  {
    const std::scoped_lock lock(guard_);
    waiting_ = asked_;
  }
  wake_.notify_one();
}

void WhyModel::work(const std::stop_token& stop) {
  for (;;) {
    WhyAsked asked;
    {
      std::unique_lock lock(guard_);
      if (!wake_.wait(lock, stop, [this] { return waiting_.has_value(); })) return;
      asked = std::move(*waiting_);
      waiting_.reset();
    }
    auto why = find_out(asked);
    const std::scoped_lock lock(guard_);
    done_ = std::move(why);
  }
}

void WhyModel::take_answer() {
  const std::scoped_lock lock(guard_);
  if (!done_) return;
  known_ = std::exchange(done_, nullptr);
  looking_ = asked_ && !same_question(known_->asked, *asked_);
}

const TickCure* WhyModel::cure() {
  const Why* why = of_tick_in_view();
  if (why != nullptr && why->told.cure.outcome == CureOutcome::found) return &why->told.cure;
  messages_.refuse(why == nullptr                          ? "pause on a tick first, and wait for its cause"
                   : why->told.cause == TickCause::nothing ? "nothing is wrong with this tick"
                                                           : "no value of a parameter cures this tick");
  return nullptr;
}

bool WhyModel::can_try() const {
  return known_ && known_->told.cure.outcome == CureOutcome::found && time_.placed() == nullptr;
}

void WhyModel::try_cure() {
  const TickCure* found = cure();
  if (found == nullptr) return;
  if (!can_try()) return messages_.refuse("at a place the value itself is tried: set it");
  Preset after = known_->asked.preset;
  found->key->set(after, found->to);
  time_.compare({"as it was", known_->asked.preset}, {"cured", after});
}

void WhyModel::set_cure() {
  if (const TickCure* found = cure()) presets_.set_value(*found->key, found->to);
}

bool WhyModel::can_go() const {
  return known_ && known_->told.mesh.triangle != kNone && !known_->told.mesh.planar &&
         known_->asked.scene == scene_.current();
}

void WhyModel::go_to_place() {
  if (of_tick_in_view() == nullptr || !can_go())
    return messages_.refuse("the cause of this tick has no place on the mesh in view");
  const MeshPlace& at = known_->told.mesh;
  const ContactMesh& mesh = known_->asked.scene->mesh();
  const auto [a, b, c] = mesh.positions(at.triangle);
  const Vec3 across = glm::cross(b - a, c - a);
  const double area2 = glm::length(across);
  view_.look_at_place(at.place, area2 > 0.0 ? across / area2 : known_->told.tick.normal, at.triangle);
  const double side = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
  Camera& camera = view_.camera;
  camera.distance_m = std::clamp(12.0 * side, 0.02 * camera.scene_radius_m, 1.2 * camera.scene_radius_m);
}

}  // namespace tangent
