#include "devices/plugin/plugin_child.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/eventfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>
#include <vector>

namespace tangent {

namespace {

constexpr const char* kHostName = "workbench-plugin";

/// What posix_spawn does before the program begins: only the two descriptors go along, what it prints goes to standard
/// error, no signal is blocked, and Ctrl-C in the terminal is not its business.
class SpawnSetup {
 public:
  SpawnSetup(int region, int life) {
    posix_spawn_file_actions_init(&actions_);
    const int apart = std::max({region, life, kLifeDescriptor}) + 1;  // where they are not in each other's way
    posix_spawn_file_actions_adddup2(&actions_, region, apart);
    posix_spawn_file_actions_adddup2(&actions_, life, apart + 1);
    posix_spawn_file_actions_adddup2(&actions_, apart, kRegionDescriptor);
    posix_spawn_file_actions_adddup2(&actions_, apart + 1, kLifeDescriptor);
    posix_spawn_file_actions_addclosefrom_np(&actions_, kLifeDescriptor + 1);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, STDERR_FILENO, STDOUT_FILENO);
    posix_spawnattr_init(&attributes_);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setsigdefault(&attributes_, &all);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnSetup() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnSetup(const SpawnSetup&) = delete;
  SpawnSetup& operator=(const SpawnSetup&) = delete;

  int spawn(pid_t& id, char* const* words) const {
    return posix_spawn(&id, words[0], &actions_, &attributes_, words, environ);
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

PluginWake::PluginWake() : descriptor_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

PluginWake::~PluginWake() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void PluginWake::wake() noexcept {
  const std::uint64_t one = 1;
  static_cast<void>(::write(descriptor_, &one, sizeof one) == sizeof one);
}

void PluginWake::clear() noexcept {
  std::uint64_t count = 0;
  static_cast<void>(::read(descriptor_, &count, sizeof count) == sizeof count);
}

void PluginWake::wait(int most_ms) noexcept {
  pollfd one{.fd = descriptor_, .events = POLLIN, .revents = 0};
  if (::poll(&one, 1, most_ms) > 0) clear();
}

Result<std::filesystem::path> plugin_host(const PluginOptions& options) {
  std::error_code unknown;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
  std::vector<std::filesystem::path> places{folder / kHostName, folder / "../libexec/tangent" / kHostName};
  if (!options.host.empty()) places = {options.host};
  std::string looked;
  for (const auto& place : places) {
    if (::access(place.c_str(), X_OK) == 0) return place;
    looked += (looked.empty() ? "" : " and ") + place.lexically_normal().string() + " (" + std::strerror(errno) + ")";
  }
  return fail("the program that plug-ins run in can't be started: looked for " + looked, kHostName,
              "build or install it beside this program, or take the plug-in into this one (--plugin-in-process)");
}

Status PluginChild::start(const PluginOptions& options, PluginRegion& region, const std::string& what_for) {
  kill();
  const auto host = plugin_host(options);
  if (!host) return tl::unexpected(host.error());
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0)
    return fail(std::string("no pipe: ") + std::strerror(errno), host->string(), "close other programs");
  std::error_code lost;  // of the working folder: then the path stays as it is
  const std::filesystem::path whole = std::filesystem::absolute(options.path, lost);
  std::vector<std::string> words{host->string(), what_for, (lost ? options.path : whole).string()};
  for (const auto& [key, value] : options.settings) {
    words.push_back(key);
    words.push_back(value);
  }
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  reaped_ = false;
  const int error = SpawnSetup(region.descriptor(), ends[1]).spawn(id_, argv.data());
  ::close(ends[1]);
  life_ = ends[0];
  if (error == 0) return {};
  id_ = 0;
  kill();
  return fail(std::string("can't be started: ") + std::strerror(error), host->string(), "build this workbench again");
}

ChildNews PluginChild::wait(const PluginWake& wake, int most_ms) noexcept {
  pollfd both[2] = {{.fd = life_, .events = POLLIN, .revents = 0},
                    {.fd = wake.descriptor(), .events = POLLIN, .revents = 0}};
  if (::poll(both, 2, most_ms) <= 0 || both[0].revents == 0) return ChildNews::none;
  char said[16];
  const ssize_t bytes = ::read(life_, said, sizeof said);
  if (bytes > 0) return ChildNews::said_something;
  if (bytes < 0 && errno == EAGAIN) return ChildNews::none;
  reap();
  return ChildNews::died;
}

// The pipe may have been closed by a plug-in that lives on: then it is no use any more.
void PluginChild::reap() noexcept {
  if (id_ <= 0) return;
  constexpr int kDying_ms = 200;
  for (int i = 0; i < kDying_ms && !reaped_; ++i) {
    reaped_ = ::waitpid(id_, &status_, WNOHANG) == id_;
    if (!reaped_) ::usleep(1000);
  }
  kill();
}

void PluginChild::kill() noexcept {
  if (id_ > 0 && !reaped_) {
    ::kill(id_, SIGKILL);
    while (::waitpid(id_, &status_, 0) < 0 && errno == EINTR) {}
    reaped_ = true;
  }
  if (life_ >= 0) ::close(life_);
  life_ = -1;
  id_ = 0;
}

bool PluginChild::died_of(int signal) const { return WIFSIGNALED(status_) && WTERMSIG(status_) == signal; }

std::string PluginChild::death() const {
  if (WIFSIGNALED(status_)) {
    const int signal = WTERMSIG(status_);
    return "ended by signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")";
  }
  return "ended by itself, with exit code " + std::to_string(WEXITSTATUS(status_));
}

}  // namespace tangent
