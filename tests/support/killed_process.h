// Work in a process of its own that is killed, as by a crash or a power cut.
#pragma once

#include <doctest/doctest.h>

#include <csignal>
#include <functional>
#include <optional>

#include <sys/wait.h>
#include <unistd.h>

namespace tangent::testing {

/// Runs `work` in a forked process, and kills it after so long; none: it ends by itself. Where it was not killed in
/// time `work` must have returned 0.
inline void run_until_killed(std::optional<unsigned> after_us, const std::function<int()>& work) {
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) ::_exit(work());
  if (after_us) {
    ::usleep(*after_us);
    ::kill(child, SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE((WIFSIGNALED(status) || WEXITSTATUS(status) == 0));
}

}  // namespace tangent::testing
