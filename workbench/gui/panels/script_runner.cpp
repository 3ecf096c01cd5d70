#include "workbench/gui/panels/script_runner.h"

#include "core/io/input_file.h"
#include "workbench/gui/panels/commands.h"

#include <algorithm>
#include <sstream>

namespace tangent {

namespace {

constexpr std::uint64_t kTicksPerFrame = 50;
constexpr int kSettlingFrames = 2;  // the window shows what a command did, and its widgets are where they will be

std::uint64_t errors_said(const MessageLog& messages) {
  std::uint64_t count = 0;
  for (const Message& m : messages.all()) count += m.severity == Severity::error ? m.times : 0;
  return count;
}

std::string last_error(const MessageLog& messages) {
  const auto& all = messages.all();
  const auto found =
      std::find_if(all.rbegin(), all.rend(), [](const Message& m) { return m.severity == Severity::error; });
  return found != all.rend() ? found->text : std::string();
}

}  // namespace

Status ScriptRunner::load(const std::filesystem::path& file) {
  if (running()) return fail("a script is running already", file.string(), "wait for its end");
  const Result<std::string> lines = read_input_file(file, std::size_t{1} << 24);
  if (!lines) return tl::unexpected(lines.error());
  return load_lines(file.string(), *lines);
}

Status ScriptRunner::load_lines(const std::string& name, const std::string& lines) {
  if (running()) return fail("a script is running already", name, "wait for its end");
  *this = ScriptRunner();
  file_ = name;
  std::istringstream in(lines);
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    lines_.push_back(line);
  }
  return {};
}

Status ScriptRunner::step(AppModel& model, MenuBar& menu, ItemMap& items) {
  if (!running()) return {};
  if (waiting_) {
    if (const std::string refused = items.take_refusal(); !refused.empty())
      return ended({refused, {}, "its part of the window may be closed; \"panel\" opens one"});
    if (!menu.wish.time_passes && errors_said(model.messages()) > errors_)
      return ended({last_error(model.messages()), {}, {}});
    if (!menu.wish.time_passes && model.messages().refusals() > refusals_)
      return ended({"was not done: " + model.messages().last_refusal(), {}, "leave the line out, or do that first"});
    if (busy(model, menu, items)) return {};
    waiting_ = false;
  }
  return run_next(model, menu);
}

Status ScriptRunner::run_next(AppModel& model, MenuBar& menu) {
  while (next_ < lines_.size()) {
    const std::string& line = lines_[next_++];
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string::npos || line[begin] == '#') continue;
    errors_ = errors_said(model.messages());
    refusals_ = model.messages().refusals();
    waiting_ = true;
    settling_ = kSettlingFrames;
    menu.wish = {};
    if (const Status done = run_line(window_commands(model, menu), line); !done) return ended(done.error());
    if (!menu.wish.script.empty() || !menu.wish.lines.empty())
      return ended({"a script can't run another", {}, "copy its lines in here"});
    if (menu.wish.ticks > 0 && !model.deterministic()) {
      until_tick_ = model.time().newest_recorded() + menu.wish.ticks;
      menu.wish.ticks = 0;
    }
    return {};
  }
  return {};
}

bool ScriptRunner::busy(AppModel& model, MenuBar& menu, const ItemMap& items) {
  if (menu.wish.ticks > 0) {
    const std::uint64_t now = std::min(menu.wish.ticks, kTicksPerFrame);
    model.advance(now);
    menu.wish.ticks -= now;
    settling_ = kSettlingFrames;
    return true;
  }
  const bool work =
      menu.wish.work &&
      (model.map().running() || model.scene().auditing() || model.time().time_machine().busy() ||
       model.tuning().search().running() || model.tuning().sweep().running() || model.time().selection_loading() ||
       model.tune().running() || model.tune().looking_for_failures() || model.curves().running());
  if (work || model.now_s() < menu.wish.until_s || model.scene().loading() || model.recordings().opening() ||
      model.exports().writing() || model.exports().picture_wanted() || !menu.wish.widget.empty() ||
      !items.wanted().empty() ||
      (model.devices().session() != nullptr && model.time().newest_recorded() < until_tick_)) {
    settling_ = kSettlingFrames;
    return true;
  }
  return settling_-- > 0;
}

Status ScriptRunner::ended(Error error) {
  error.where = file_.string() + ":" + std::to_string(next_) + (error.where.empty() ? "" : ", " + error.where);
  *this = ScriptRunner();
  return tl::unexpected(std::move(error));
}

}  // namespace tangent
