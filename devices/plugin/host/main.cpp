// workbench-plugin: the process that a plug-in lives in (devices/plugin/README.md). Started by the workbench, with the
// shared memory and a pipe as descriptors 3 and 4:
//
//   workbench-plugin describe|run PLUGIN.so [KEY VALUE]...
//
// The pipe says that there is something to see, and, by its end, that this process is gone.
#include "devices/base/realtime_thread.h"
#include "devices/plugin/host/allocation_watch.h"
#include "devices/plugin/host/crash_handler.h"
#include "devices/plugin/host/plugin_host.h"
#include "devices/plugin/host/process_limits.h"

#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <string_view>

namespace tangent {
namespace {

constexpr double kLongestLoop = 5.0;  // in terms of hang_s, after which the second thread stops the device

void tell(PluginRegion& region, HostPhase phase) {
  region.to_program().phase.store(phase, std::memory_order_release);
  static_cast<void>(::write(kLifeDescriptor, "p", 1) == 1);
}

int say_failed(PluginRegion& region, const Error& error) {
  region.to_program().what.put(PluginText(error.where.empty() ? error.what : error.where + ": " + error.what));
  region.to_program().remedy.put(PluginText(error.remedy));
  tell(region, HostPhase::failed);
  return 1;
}

/// Until the device is opened nothing needs to be stopped, and a plug-in that hangs must not outlive the program. From
/// then on the second thread takes SIGTERM; Ctrl-C and a closed terminal are the program's.
void prepare_signals() {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  prctl(PR_SET_TIMERSLACK, 1UL);  // ns
  sigset_t blocked;
  sigemptyset(&blocked);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGQUIT, SIGTSTP, SIGTTIN, SIGTTOU, SIGPIPE})
    sigaddset(&blocked, signal);
  pthread_sigmask(SIG_BLOCK, &blocked, nullptr);
}

PluginSettings settings_of(int argc, char** argv) {
  PluginSettings settings;
  for (int i = 3; i + 1 < argc; i += 2) settings.emplace_back(argv[i], argv[i + 1]);
  return settings;
}

int run(PluginRegion& region, PluginLibrary& library) {
  std::atomic<HostPlace>& place = region.to_program().place;
  PluginHost host(region, library);
  host.watch();
  prctl(PR_SET_PDEATHSIG, SIGTERM);  // a program that died before this line is missed by the second thread
  place.store(HostPlace::open);
  if (const Status ok = library.open(); !ok) return say_failed(region, ok.error());
  place.store(HostPlace::own);
  stop_in_a_crash(library);
  limit_realtime(kLongestLoop * region.to_host().hang_s);
  if (region.to_host().realtime != 0) ask_for_realtime(kServoPriority);  // without it it answers with more jitter
  host.serve();
  constexpr sched_param kNone{};
  ::sched_setscheduler(0, SCHED_OTHER, &kNone);                           // closing may take its time
  ::alarm(static_cast<unsigned>(PluginHost::longest_end_s(region)) + 3);  // nobody else would, with the program gone
  place.store(HostPlace::close);
  library.close();
  leave_crashes_alone();
  place.store(HostPlace::own);
  tell(region, HostPhase::ended);
  return 0;
}

int host_main(int argc, char** argv) {
  const std::string_view what_for = argc > 2 ? argv[1] : "";
  PluginRegion region;
  if ((what_for != "run" && what_for != "describe") || !region.attach(kRegionDescriptor)) {
    std::fputs(
        "workbench-plugin: the process of a plug-in, started by the workbench of the same version, not by hand\n",
        stderr);
    return 2;
  }
  for (const int mine : {kRegionDescriptor, kLifeDescriptor}) ::fcntl(mine, F_SETFD, FD_CLOEXEC);
  prepare_signals();
  if (::getppid() != region.to_host().program) return 1;  // died before the line above
  count_refusals(region.to_program().refused);
  if (!limit_memory(region.to_host().memory_bytes))
    std::fputs("workbench-plugin: the memory of the plug-in can't be limited\n", stderr);
  std::atomic<HostPlace>& place = region.to_program().place;
  place.store(HostPlace::loading);
  auto library = PluginLibrary::load(argv[2], settings_of(argc, argv));
  if (!library) return say_failed(region, library.error());
  place.store(HostPlace::capabilities);
  const auto can = (*library)->capabilities();
  if (!can) return say_failed(region, can.error());
  region.to_program().capabilities.put(*can);
  place.store(HostPlace::own);
  if (what_for == "run") return run(region, **library);
  tell(region, HostPhase::described);
  return 0;
}

}  // namespace
}  // namespace tangent

int main(int argc, char** argv) { return tangent::host_main(argc, argv); }
