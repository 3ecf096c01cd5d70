#include "workbench/gui/model/evidence_model.h"

#include "core/base/text.h"
#include "core/io/atomic_file.h"
#include "core/lab/objects/generate_hard.h"
#include "workbench/evidence/made_mesh.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace tangent {

namespace {

constexpr const char* kSavedPoses = ".poses.csv";  // after the preset's name

void append_row(std::string& text, const TickInput& input) {
  const Vec3& p = input.finger.position;
  const Quat& q = input.finger.orientation;
  const char* comma = "";
  for (const double value : {input.t_s, p.x, p.y, p.z, q.w, q.x, q.y, q.z}) {
    append_double(text += comma, value);
    comma = ",";
  }
  text += '\n';
}

std::string poses_text(std::span<const TickInput> poses) {
  std::string text = "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n";
  for (const TickInput& input : poses) append_row(text, input);
  return text;
}

bool is_generated(const std::string& mesh) {
  for (const auto* names : {&generator_names(), &hard_mesh_names()}) {
    if (std::find(names->begin(), names->end(), mesh) != names->end()) return true;
  }
  return false;
}

}  // namespace

EvidenceModel::EvidenceModel(const AppOptions& options, PresetModel& presets, const SceneModel& scene,
                             const TimeModel& time, MessageLog& messages)
    : presets_(presets), scene_(scene), time_(time), messages_(messages), deterministic_(options.deterministic) {}

void EvidenceModel::update() {
  if (auto done = job_.take()) {
    if (PresetCheck* check = std::get_if<PresetCheck>(&*done))
      result_ = std::move(*check);
    else
      take(std::move(std::get<Result<PresetFile>>(*done)));
  }
  const PresetEditor& editor = presets_.editor();
  if (editor.path() == checked_path_ && editor.loaded() == checked_) return;
  checked_path_ = editor.path();
  checked_ = editor.loaded();
  result_.reset();
  if (!attached_to_.empty() && attached_to_ == checked_path_) return;  // it is being measured
  job_.cancel();
  if (!deterministic_ && !checked_path_.empty()) check();
}

void EvidenceModel::check() {
  const PresetEditor& editor = presets_.editor();
  if (editor.path().empty()) return messages_.refuse("the program's own values name no evidence");
  attached_to_.clear();
  checked_path_ = editor.path();
  checked_ = editor.loaded();
  result_.reset();
  job_.check(checked_, checked_path_.parent_path(), !deterministic_);
}

void EvidenceModel::cancel() {
  if (!attached_to_.empty() && job_.running())
    messages_.say(Severity::note, attached_to_.string() + " is saved, without evidence");
  attached_to_.clear();
  job_.cancel();
}

std::string EvidenceModel::label() const {
  if (job_.running()) return attached_to_.empty() ? "checking" : "measuring";
  return result_ ? to_string(result_->outcome) : "";
}

std::optional<RunPart> EvidenceModel::selected_run() const {
  if (!time_.selection()) return std::nullopt;
  auto part = time_.run_over(*time_.selection());
  if (!part) return std::nullopt;
  const HistorySnapshot& records = part->run.records;
  const std::uint32_t id = records.newest().scene_id;
  const auto scene = part->run.scenes.find(id);
  const bool here = scene != part->run.scenes.end() && scene->second == scene_.current();
  if (!here || records[part->first].scene_id != id) return std::nullopt;
  return part;
}

PresetEvidence EvidenceModel::asked_for(EvidenceMotion motion, const std::filesystem::path& folder) const {
  PresetEvidence asked;
  asked.command = "saved in the window";
  asked.motion = std::move(motion);
  const std::string& mesh = scene_.path();
  asked.mesh.source = is_generated(mesh) ? made_text({mesh, {}}) : seen_from(folder, mesh);
  asked.mesh.metres_per_unit = scene_.metres_per_unit();
  asked.mesh.options = scene_.mesh_options();
  return asked;
}

void EvidenceModel::attach_selection() {
  const auto part = selected_run();
  if (!part) return;
  std::vector<TickInput> poses;
  for (std::size_t i = part->first; i < part->run.records.size(); ++i) poses.push_back(part->run.records[i].tick.input);
  EvidenceMotion motion;
  motion.kind = MotionKind::poses;
  attach(std::move(motion), poses);
}

void EvidenceModel::attach(EvidenceMotion motion, std::span<const TickInput> poses) {
  const PresetEditor& editor = presets_.editor();
  const std::filesystem::path folder = editor.path().parent_path(), file = folder / (editor.name() + kSavedPoses);
  if (motion.kind == MotionKind::poses) {
    if (Status written = write_file_atomic(file, poses_text(poses)); !written)
      return messages_.say(Severity::error, written.error().message());
    motion.file = seen_from(folder, file);
  }
  attached_to_ = editor.path();
  job_.attach(editor.loaded(), asked_for(std::move(motion), folder), folder, !deterministic_);
}

void EvidenceModel::take(Result<PresetFile> attached) {
  const std::filesystem::path to = std::exchange(attached_to_, {});
  if (!attached) return messages_.say(Severity::error, "no evidence was attached: " + attached.error().message());
  if (Status written = presets_.save_evidence(to, *attached); !written)
    return messages_.say(Severity::error, written.error().message());
  const EvidenceNumbers& n = attached->about.measured->numbers;
  messages_.say(Severity::note, "preset " + to.stem().string() + " names its evidence: " +
                                    std::to_string(static_cast<std::uint64_t>(n.ticks)) + " ticks");
  checked_path_ = presets_.editor().path();
  checked_ = presets_.editor().loaded();
  PresetCheck fresh;
  fresh.outcome = CheckOutcome::holds;
  fresh.same_build = true;
  fresh.now = n;
  result_ = fresh;
}

}  // namespace tangent
