#include "workbench/cli/trial_keys.h"

#include "core/base/text.h"
#include "core/io/csv_table.h"

#include <array>
#include <cstdio>

#include <poll.h>
#include <unistd.h>

namespace tangent {
namespace {

using experiment::TrialKey;

constexpr char kEscape = 27;
constexpr double kLongestWait_s = 3600.0;
constexpr std::size_t kLongestKeyLine = 4096;

struct NamedKey {
  std::string_view line;
  char key;
  TrialKey means;
};
constexpr std::array kNamedKeys{NamedKey{"enter", '\n', TrialKey::enter},  NamedKey{"", '\r', TrialKey::enter},
                                NamedKey{"stop", kEscape, TrialKey::stop}, NamedKey{"resume", 'r', TrialKey::resume},
                                NamedKey{"lift", ' ', TrialKey::lift},     NamedKey{"quit", 'q', TrialKey::quit}};

std::string printable(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (static_cast<unsigned char>(c) < ' ' || c == 127) c = ' ';
  return out;
}

bool is_digit_key(std::string_view text) { return text.size() == 1 && text[0] >= '1' && text[0] <= '9'; }

}  // namespace

Result<TrialInput> trial_input_of(const std::string& text) {
  TrialInput out;
  std::string_view line = text;
  if (line.ends_with('\r')) line.remove_suffix(1);
  if (line.size() > kLongestKeyLine)
    return fail("has a line of more than " + std::to_string(kLongestKeyLine) + " characters", "standard input",
                "write shorter notes");
  if (is_digit_key(line)) {
    out.key = experiment::digit_key(line[0] - '0');
    return out;
  }
  for (const NamedKey& named : kNamedKeys)
    if (line == named.line) return out.key = named.means, out;
  if (line.starts_with("note ")) return out.note = printable(line.substr(5)), out;
  if (line.starts_with("wait "))
    if (const auto seconds = parse_finite_double(line.substr(5));
        seconds && *seconds > 0.0 && *seconds <= kLongestWait_s)
      return out.wait_s = *seconds, out;
  return fail(show_text(line) + " is no key", "standard input",
              "write enter, 1 to 9, stop, resume, lift, quit, note TEXT or wait S, a line each");
}

void TrialKeys::read_some() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (ended_ || ::poll(&input, 1, 0) <= 0) return;
  std::array<char, 256> bytes;
  const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
  if (count <= 0)
    ended_ = true;
  else
    buffer_.append(bytes.data(), static_cast<std::size_t>(count));
}

std::optional<TrialInput> TrialKeys::next_key() {
  TrialInput out;
  const char key = buffer_.front();
  buffer_.erase(0, 1);
  if (noting_) {
    std::fputc(key, stdout);
    std::fflush(stdout);
    noting_ = key != '\n' && key != '\r';
    if (noting_) return note_ += key, std::nullopt;
    out.note = std::exchange(note_, {});
    return out;
  }
  if (key == kEscape) buffer_.clear();  // of an arrow key there is more
  if (key == 'n') {
    noting_ = true;
    std::fputs("Note: ", stdout);
    std::fflush(stdout);
    return std::nullopt;
  }
  if (is_digit_key({&key, 1})) return out.key = experiment::digit_key(key - '0'), out;
  for (const NamedKey& named : kNamedKeys)
    if (key == named.key) return out.key = named.means, out;
  return std::nullopt;
}

Result<std::optional<TrialInput>> TrialKeys::next() {
  read_some();
  if (terminal()) return buffer_.empty() ? std::nullopt : next_key();
  const std::size_t end = buffer_.find('\n');
  if (end == std::string::npos && !(ended_ && !buffer_.empty()) && buffer_.size() <= kLongestKeyLine)
    return std::nullopt;
  const std::string line = buffer_.substr(0, end);
  buffer_.erase(0, end == std::string::npos ? end : end + 1);
  auto input = trial_input_of(line);
  if (input) return std::optional(std::move(*input));
  if (line.size() > kLongestKeyLine) return tl::unexpected(input.error());
  TrialInput wrong;
  wrong.wrong = input.error().message();
  return std::optional(std::move(wrong));
}

}  // namespace tangent
