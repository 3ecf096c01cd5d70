#include "workbench/session/raw_terminal.h"

#include <unistd.h>

#include <atomic>

namespace tangent {

namespace {

std::atomic<const RawTerminal*> in_use{nullptr};
static_assert(std::atomic<const RawTerminal*>::is_always_lock_free, "used by handlers");

void set_terminal(const termios& wanted) noexcept {
  if (::tcgetpgrp(STDIN_FILENO) == ::getpgrp()) ::tcsetattr(STDIN_FILENO, TCSANOW, &wanted);
}

}  // namespace

RawTerminal::RawTerminal() noexcept {
  if (::isatty(STDIN_FILENO) == 0 || ::tcgetattr(STDIN_FILENO, &before_) != 0) return;
  raw_ = before_;
  raw_.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  in_use.store(this);  // before it is set, so that no signal comes in between
  active_ = ::tcsetattr(STDIN_FILENO, TCSANOW, &raw_) == 0;
}

RawTerminal::~RawTerminal() {
  if (active_) ::tcsetattr(STDIN_FILENO, TCSANOW, &before_);
  in_use.store(nullptr);
}

void give_terminal_back() noexcept {
  if (const RawTerminal* mine = in_use.load()) set_terminal(mine->before_);
}

void take_terminal_again() noexcept {
  if (const RawTerminal* mine = in_use.load()) set_terminal(mine->raw_);
}

}  // namespace tangent
