#include "workbench/cli/answer_keys.h"

#include "core/io/csv_table.h"

#include <array>
#include <cstdio>

#include <poll.h>
#include <unistd.h>

namespace tangent {
namespace {

constexpr char kEscapeKey = 27;
constexpr std::size_t kLongestAnswer = 256;

bool erases(char key) { return key == 0x7f || key == 8; }

}  // namespace

std::optional<AnswerKey> answer_of_line(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  if (line == "yes") return AnswerKey::yes;
  if (line == "no") return AnswerKey::no;
  if (line == "skip") return AnswerKey::skip;
  if (line == "stop") return AnswerKey::stop;
  return std::nullopt;
}

std::optional<AnswerKey> answer_of_key(char key) {
  if (key == 'y' || key == '\n' || key == '\r') return AnswerKey::yes;
  if (key == 'n') return AnswerKey::no;
  if (key == 's') return AnswerKey::skip;
  if (key == kEscapeKey || key == 'q' || key == ' ') return AnswerKey::stop;
  return std::nullopt;
}

void AnswerKeys::read_some() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  while (!ended_ && buffer_.size() <= kLongestAnswer && ::poll(&input, 1, 0) > 0) {
    std::array<char, 256> bytes;
    const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    if (count <= 0)
      ended_ = true;
    else
      buffer_.append(bytes.data(), static_cast<std::size_t>(count));
  }
}

bool AnswerKeys::wants_stop() {
  read_some();
  if (!terminal()) return buffer_.starts_with("stop\n") || buffer_ == "stop";
  for (const char key : buffer_)
    if (answer_of_key(key) == AnswerKey::stop) return true;
  return false;
}

void AnswerKeys::drop() {
  if (wants_stop()) return;  // which also reads
  buffer_.clear();
  shown_ = 0;
}

void AnswerKeys::show_typed() {
  for (; terminal() && shown_ < buffer_.size() && buffer_[shown_] != '\n'; ++shown_)
    std::fputs(erases(buffer_[shown_]) ? "\b \b" : std::string(1, buffer_[shown_]).c_str(), stdout);
  std::fflush(stdout);
}

std::optional<std::string> AnswerKeys::next_line() {
  read_some();
  show_typed();
  const std::size_t end = buffer_.find('\n');
  const bool whole = end != std::string::npos || buffer_.size() > kLongestAnswer || (ended_ && !buffer_.empty());
  if (!whole) return std::nullopt;
  std::string line;
  for (const char key : buffer_.substr(0, end)) {
    if (!erases(key))
      line += key;
    else if (!line.empty())
      line.pop_back();
  }
  if (line.ends_with('\r')) line.pop_back();
  buffer_.erase(0, end == std::string::npos ? end : end + 1);
  shown_ = 0;
  if (terminal()) std::fputs("\n", stdout);
  return line;
}

Result<std::optional<AnswerKey>> AnswerKeys::next() {
  read_some();
  if (buffer_.empty()) return std::optional<AnswerKey>();
  if (terminal()) {
    const char key = buffer_.front();
    buffer_.erase(0, key == kEscapeKey ? std::string::npos : 1);  // of an arrow key there is more
    return answer_of_key(key);
  }
  const std::size_t end = buffer_.find('\n');
  if (end == std::string::npos && !ended_ && buffer_.size() <= kLongestAnswer) return std::optional<AnswerKey>();
  const std::string line = buffer_.substr(0, end);
  buffer_.erase(0, end == std::string::npos ? end : end + 1);
  const auto answer = answer_of_line(line);
  if (!answer)
    return fail(show_text(line) + " is no answer", "standard input", "write yes, no, skip or stop, a line each");
  return answer;
}

}  // namespace tangent
