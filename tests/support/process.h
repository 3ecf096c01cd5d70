// Runs the program as a separate process.
#pragma once

#include "tests/support/paths.h"
#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <cerrno>
#include <csignal>
#include <ostream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tangent::testing {

/// Compares as a number; a failed check also prints the output of the process.
struct ExitCode {
  int number = -1;  ///< -1: ended by a signal
  std::string said;

  friend bool operator==(const ExitCode& code, int number) { return code.number == number; }
  friend std::ostream& operator<<(std::ostream& out, const ExitCode& code) {
    return out << code.number << ", having said \"" << code.said << '"';
  }
};

struct ProcessResult {
  ExitCode exit_code;
  std::string out, err;
  long peak_kb = 0;  ///< of its memory
};

/// A running process. Its output goes to files, so it never blocks.
class Process {
 public:
  explicit Process(std::vector<std::string> arguments, const std::string& program = testing::program()) {
    arguments.insert(arguments.begin(), program);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    const std::string out = folder_.file("out"), err = folder_.file("err");
    id_ = ::fork();
    if (id_ != 0) return;
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect(out, O_WRONLY | O_CREAT, STDOUT_FILENO);
    redirect(err, O_WRONLY | O_CREAT, STDERR_FILENO);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }

  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  /// A test that fails before it has waited leaves nothing running.
  ~Process() {
    if (waited_) return;
    ::kill(id_, SIGKILL);
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {}
  }

  void interrupt(int signal = SIGINT) const { ::kill(id_, signal); }

  bool ended() const {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == id_;
  }

  ProcessResult wait() const {
    int status = 0;
    struct rusage usage {};
    while (::wait4(id_, &status, 0, &usage) < 0 && errno == EINTR) {}
    waited_ = true;
    const std::string err = read_text(folder_.file("err"));
    // A sanitizer's report fails the test even where the program is expected to fail.
    CHECK_MESSAGE(!contains(err, "Sanitizer"), err);
    return {{WIFEXITED(status) ? WEXITSTATUS(status) : -1, err}, read_text(folder_.file("out")), err, usage.ru_maxrss};
  }

 private:
  static void redirect(const std::string& path, int flags, int descriptor) {
    const int file = ::open(path.c_str(), flags, 0600);
    if (file < 0 || ::dup2(file, descriptor) < 0) ::_exit(126);
  }

  TempFolder folder_;
  pid_t id_ = 0;
  mutable bool waited_ = false;
};

inline ProcessResult run_workbench(std::vector<std::string> arguments) { return Process(std::move(arguments)).wait(); }

}  // namespace tangent::testing
