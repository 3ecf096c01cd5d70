#include "devices/plugin/plugin_process.h"

#include "devices/plugin/plugin_within.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <system_error>

#include <unistd.h>

namespace tangent {

namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;
constexpr int kLook_ms = 20;  ///< between two looks at whether it hangs

std::int64_t nanoseconds(double seconds) { return static_cast<std::int64_t>(seconds * static_cast<double>(kNsPerS)); }

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%g s", seconds);
  return text;
}

/// Where its process was refused memory: that, and what to do.
std::string refused_what(const PluginOptions& options) {
  char text[96];
  std::snprintf(text, sizeof text, "after it got no more memory than its %g MB", options.memory_mb);
  return text;
}
constexpr const char* kRefusedRemedy =
    "mend the plug-in where it allocates without end, or let it have more: --plugin-memory-mb MB";

bool was_refused(const PluginRegion& region, const PluginOptions& options) {
  return options.memory_mb > 0.0 && region.to_program().refused.load() != 0;
}

const char* remedy_of_death(const PluginChild& child, HostPlace place) {
  if (child.died_of(SIGXCPU)) return "exchange must not loop until something happens: return, and look again next time";
  return place == HostPlace::own ? "look at what it printed, and at the memory of the machine"
                                 : "run workbench-plugin in a debugger, or mend the plug-in there";
}

Error why_it_died(const PluginChild& child, const PluginRegion& region, const PluginOptions& options) {
  const HostPlace place = region.to_program().place.load();
  const std::string how = "its process " + child.death() + ", " + to_string(place);
  if (was_refused(region, options)) return {how + ", " + refused_what(options), options.path.string(), kRefusedRemedy};
  return {how, options.path.string(), remedy_of_death(child, place)};
}

Error why_it_failed(const PluginRegion& region, const PluginOptions& options) {
  PluginText what, remedy;
  std::uint32_t first = 0, second = 0;
  region.to_program().what.take(what, first);
  region.to_program().remedy.take(remedy, second);
  if (!was_refused(region, options)) return {std::string(what.view()), {}, std::string(remedy.view())};
  return {std::string(what.view()) + ", " + refused_what(options), {}, kRefusedRemedy};
}

/// Until it has come as far as `wanted`.
Status await(PluginChild& child, const PluginRegion& region, HostPhase wanted, const PluginOptions& options,
             PluginWake& wake, const std::atomic<bool>& ending) {
  const std::int64_t until_ns = plugin_now_ns() + nanoseconds(options.open_s);
  for (bool died = false;;) {
    const HostPhase phase = region.to_program().phase.load(std::memory_order_acquire);
    if (phase == HostPhase::failed) return tl::unexpected(why_it_failed(region, options));
    if (phase == wanted) return {};
    if (died) return tl::unexpected(why_it_died(child, region, options));
    const std::int64_t left_ns = until_ns - plugin_now_ns();
    if (ending.load()) return fail("was closed before it had opened", options.path.string(), "open it again");
    if (left_ns <= 0)
      return fail("did not open within " + seconds_text(options.open_s) + " (" +
                      to_string(region.to_program().place.load()) + ")",
                  options.path.string(), "see whether its device is there, and what the plug-in waits for");
    died = child.wait(wake, static_cast<int>(std::min<std::int64_t>(left_ns / 1'000'000 + 1, 1000))) == ChildNews::died;
  }
}

Result<tangent_device_capabilities> said_capabilities(const PluginRegion& region, const PluginOptions& options) {
  tangent_device_capabilities can{};
  std::uint32_t none = 0;
  if (region.to_program().capabilities.take(can, none)) return can;
  return fail("did not say what its device can do", options.path.string(),
              "use the workbench-plugin of this workbench");
}

Status prepare(PluginRegion& region, const PluginOptions& options) {
  if (!region.create())
    return fail("no memory to share with its process", options.path.string(), "close other programs");
  ToHost& to_host = region.to_host();
  to_host.realtime = options.realtime ? 1 : 0;
  to_host.program = ::getpid();
  to_host.watchdog_s = options.watchdog_s;
  to_host.hang_s = options.hang_s;
  to_host.end_s = options.end_s;
  to_host.memory_bytes = static_cast<std::uint64_t>(1e6 * std::max(0.0, options.memory_mb));
  return {};
}

/// Closes the device; the process ends.
void finish(PluginChild& child, PluginRegion& region, const PluginOptions& options, PluginWake& wake) {
  region.to_host().end.store(1);
  ring_bell(region.to_host().bell);
  const std::int64_t until_ns = plugin_now_ns() + nanoseconds(options.end_s);
  for (std::int64_t left_ns = until_ns - plugin_now_ns(); left_ns > 0; left_ns = until_ns - plugin_now_ns()) {
    wake.clear();
    if (child.wait(wake, static_cast<int>(left_ns / 1'000'000 + 1)) == ChildNews::died) return;
  }
  child.kill();
}

}  // namespace

Result<tangent_device_capabilities> PluginProcess::describe() {
  PluginRegion region;
  if (const Status ok = prepare(region, options_); !ok) return tl::unexpected(ok.error());
  PluginChild child;
  PluginWake wake;
  if (const Status ok = child.start(options_, region, "describe"); !ok) return tl::unexpected(ok.error());
  const std::atomic<bool> never{false};
  if (const Status ok = await(child, region, HostPhase::described, options_, wake, never); !ok)
    return tl::unexpected(ok.error());
  finish(child, region, options_, wake);
  return said_capabilities(region, options_);
}

Status PluginProcess::open(const tangent_device_capabilities& as_said) {
  if (!mapped_) {
    if (const Status ok = prepare(region_, options_); !ok) return ok;
    mapped_ = true;
  }
  as_said_ = as_said;
  first_.reset();
  connections_before_ = connection_.load();
  ending_.store(false);
  wake_.clear();
  try {
    thread_ = std::thread([this] { run(); });
  } catch (const std::system_error&) {
    return fail("no thread could be started", options_.path.string(),
                "end other programs, or raise the limit on threads");
  }
  Status status;
  {
    std::unique_lock lock(mutex_);
    first_done_.wait(lock, [this] { return first_.has_value(); });
    status = *first_;
  }
  if (!status) end();
  return status;
}

void PluginProcess::end() {
  if (!thread_.joinable()) return;
  ending_.store(true);
  wake_.wake();
  thread_.join();
}

// --- Its own thread ------------------------------------------------------------------------------------

void PluginProcess::say(const std::string& problem) {
  const std::lock_guard lock(mutex_);
  problem_ = problem;
}

void PluginProcess::opened(Status status) {
  const std::lock_guard lock(mutex_);
  if (!first_) first_ = std::move(status);
  first_done_.notify_all();
}

Status PluginProcess::start_one(PluginChild& child) {
  region_.to_program().phase.store(HostPhase::starting);
  region_.to_program().place.store(HostPlace::own);
  region_.to_program().refused.store(0);
  region_.to_host().end.store(0);
  region_.to_host().connection.store(connection_.load() + 1);  // as watch_one counts
  if (const Status ok = child.start(options_, region_, "run"); !ok) return ok;
  if (const Status ok = await(child, region_, HostPhase::opened, options_, wake_, ending_); !ok) return ok;
  const auto can = said_capabilities(region_, options_);
  const Status same = can ? same_as_said(*can, as_said_, options_.path.string()) : tl::unexpected(can.error());
  if (!same) finish(child, region_, options_, wake_);
  return same;
}

bool PluginProcess::hangs() noexcept {
  PluginAnswer newest;
  std::uint32_t none = 0;
  const bool any = region_.to_program().answer.take(newest, none);
  const std::uint64_t sent = sent_.load(), answered = std::max(sent_before_, any ? newest.number : 0);
  const std::int64_t now_ns = plugin_now_ns();
  if (answered >= sent || answered != answered_ || behind_since_ns_ == 0) behind_since_ns_ = now_ns;
  answered_ = answered;
  return now_ns - behind_since_ns_ > nanoseconds(options_.kill_s);
}

void PluginProcess::watch_one(PluginChild& child) {
  say({});
  sent_before_ = sent_.load();
  behind_since_ns_ = 0;
  verdict_.store(PluginVerdict::none);
  connection_.fetch_add(1);
  connected_.store(true, std::memory_order_release);
  opened({});  // now: an exchange right after open is connected
  ChildNews news = ChildNews::none;
  bool hung = false;
  while (!ending_.load() && news != ChildNews::died && !hung) {
    news = child.wait(wake_, kLook_ms);
    hung = hangs();
  }
  connected_.store(false, std::memory_order_release);
  if (news == ChildNews::died) {
    say(why_it_died(child, region_, options_).message() + "; it is started again");
  } else if (ending_.load()) {
    finish(child, region_, options_, wake_);
  } else {
    child.kill();
    say(options_.path.string() + ": did not answer for " + seconds_text(options_.kill_s) + ", " +
        to_string(region_.to_program().place.load()) +
        "; its process was killed and is started again; exchange must not wait");
  }
  ring_bell(region_.to_program().bell);  // an exchange that waits for an answer needn't any longer
}

void PluginProcess::run() {
  constexpr int kMostDoublings = 4;
  constexpr double kLongestPause_s = 5.0;
  for (int failures = 0; !ending_.load();) {
    PluginChild child;
    const Status ok = start_one(child);
    const bool first = connection_.load() == connections_before_;
    if (ok) {
      failures = 0;
      watch_one(child);
    } else if (first) {
      return opened(ok);
    } else {
      say(ok.error().message());
      failures = std::min(failures + 1, kMostDoublings);
    }
    child.kill();
    const double pause_s = std::min(std::ldexp(options_.restart_s, failures), kLongestPause_s);
    const std::int64_t until_ns = plugin_now_ns() + nanoseconds(pause_s);
    while (!ending_.load() && plugin_now_ns() < until_ns)
      wake_.wait(static_cast<int>((until_ns - plugin_now_ns()) / 1'000'000 + 1));
  }
}

// --- Servo thread --------------------------------------------------------------------------------------

PluginTurn PluginProcess::exchange(const PluginCommand& command, double wait_s) noexcept {
  PluginTurn turn{.connected = connected_.load(std::memory_order_acquire), .connection = connection_.load()};
  if (!turn.connected) return turn;
  region_.to_host().command.put(command);
  sent_.store(command.number);
  ring_bell(region_.to_host().bell);
  ToProgram& from = region_.to_program();
  const std::int64_t until_ns = wait_s > 0.0 ? plugin_now_ns() + nanoseconds(wait_s) : 0;
  while (true) {
    const std::uint32_t seen = from.bell.load(std::memory_order_acquire);
    turn.connected = connected_.load(std::memory_order_acquire);
    if (from.answer.take(turn.answer, answer_sequence_)) turn.answered = true;
    if (!turn.connected || (turn.answered && turn.answer.number >= command.number)) break;
    if (wait_s <= 0.0 || plugin_now_ns() >= until_ns) break;
    wait_for_bell(from.bell, seen, until_ns);
  }
  if (turn.answered) verdict_.store(turn.answer.verdict, std::memory_order_relaxed);
  return turn;
}

// --- Any thread ----------------------------------------------------------------------------------------

bool PluginProcess::emergency_stop() noexcept {
  if (!connected_.load(std::memory_order_acquire)) return false;
  region_.to_host().stops.fetch_add(1);
  return true;
}

void PluginProcess::report(LinkReport& out) const {
  out.connected = connected_.load(std::memory_order_acquire);
  out.connects = connection_.load();
  out.identity = options_.path.filename().string() + ", in a process of its own";
  {
    const std::lock_guard lock(mutex_);
    out.problem = problem_;
  }
  const PluginVerdict verdict = verdict_.load(std::memory_order_relaxed);
  if (!out.problem.empty() || verdict == PluginVerdict::none) return;
  out.problem = options_.path.string() + ": " + to_string(verdict);
  if (verdict == PluginVerdict::failed) {
    PluginText said;
    std::uint32_t none = 0;
    if (region_.to_program().what.take(said, none)) out.problem += ": " + std::string(said.view());
  }
  const bool refused = was_refused(region_, options_);
  if (refused) out.problem += ", " + refused_what(options_);
  out.problem += std::string("; ") + (refused ? kRefusedRemedy : remedy(verdict));
}

}  // namespace tangent
