#include "workbench/gui/panels/command_match.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace tangent {

namespace {

constexpr double kLeast = 0.4;     // of a row's score, and of every word's
constexpr double kSynonym = 0.85;  // of what a word of the title counts
constexpr double kUnsaid = 0.015;  // off for every word of the title that was not typed

/// Words in lower case: letters and digits. "G_k" is one, and so is "1.5".
std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> out;
  std::string word;
  for (const char c : text) {
    const bool part = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || (c & 0x80) != 0;
    if (part) {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!word.empty()) {
      out.push_back(std::move(word));
      word.clear();
    }
  }
  if (!word.empty()) out.push_back(std::move(word));
  return out;
}

/// One letter is missing, too much, another one, or two have changed places.
bool slip(std::string_view a, std::string_view b) {
  if (a.size() > b.size()) std::swap(a, b);
  if (b.size() - a.size() > 1) return false;
  std::size_t i = 0;
  while (i < a.size() && a[i] == b[i]) ++i;
  if (a.size() < b.size()) return a.substr(i) == b.substr(i + 1);
  if (i == a.size() || a.substr(i + 1) == b.substr(i + 1)) return true;
  return i + 1 < a.size() && a[i] == b[i + 1] && a[i + 1] == b[i] && a.substr(i + 2) == b.substr(i + 2);
}

double word_score(std::string_view word, std::string_view typed) {
  if (word == typed) return 1.0;
  const double share = static_cast<double>(typed.size()) / static_cast<double>(std::max<std::size_t>(word.size(), 1));
  if (word.starts_with(typed)) return 0.75 + 0.2 * share;
  if (typed.size() >= 4 && word.find(typed) != std::string_view::npos) return 0.45 + 0.2 * share;
  // Of four letters another word is often one letter off (save, safe): there only two that have changed places.
  const bool swapped = word.size() == typed.size() && std::is_permutation(word.begin(), word.end(), typed.begin());
  if ((typed.size() >= 5 || (typed.size() == 4 && swapped)) && slip(word, typed)) return 0.6;
  return 0.0;
}

double best_of(const std::vector<std::string>& words, std::string_view typed, std::vector<bool>* said) {
  double best = 0.0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const double score = word_score(words[i], typed);
    if (score > best) best = score, at = i;
  }
  if (said != nullptr && best > 0.0) (*said)[at] = true;
  return best;
}

bool is_value(std::string_view word) {
  return !word.empty() && (std::isdigit(static_cast<unsigned char>(word.front())) != 0 ||
                           (word.size() > 1 && (word.front() == '-' || word.front() == '.') &&
                            std::isdigit(static_cast<unsigned char>(word[1])) != 0));
}

struct Split {
  std::string words, value;
};

/// "curvature gain 12 mm": the words before the first number, and the value from there on.
Split split_number(std::string_view typed) {
  for (std::size_t at = 0; at < typed.size(); ++at) {
    if (at != 0 && typed[at - 1] != ' ') continue;
    if (is_value(typed.substr(at, typed.find(' ', at) - at)))
      return {std::string(typed.substr(0, at)), std::string(typed.substr(at))};
  }
  return {std::string(typed), {}};
}

/// "pause on": the words before it.
Split split_on_off(std::string_view typed) {
  for (const std::string_view word : {" on", " off"})
    if (typed.ends_with(word))
      return {std::string(typed.substr(0, typed.size() - word.size())), std::string(word.substr(1))};
  return {std::string(typed), {}};
}

PaletteRow with_value(PaletteRow row, const std::string& value) {
  row.line += " " + value;
  row.title += " " + value;
  row.complete = true;
  return row;
}

/// The row under this text with its score; 0: not meant.
std::pair<double, PaletteRow> scored(const PaletteRow& row, std::string_view typed) {
  const double plain = match_score(row.title, row.words, typed);
  if (row.takes == ArgumentKind::text && typed.size() > row.line.size() + 1 && typed.starts_with(row.line + " "))
    return {1.0, with_value(row, std::string(typed.substr(row.line.size() + 1)))};
  if (row.takes == ArgumentKind::number || row.takes == ArgumentKind::on_off) {
    const Split split = row.takes == ArgumentKind::number ? split_number(typed) : split_on_off(typed);
    const double score = split.value.empty() ? 0.0 : match_score(row.title, row.words, split.words);
    if (score > 0.0 && score >= plain) return {score, with_value(row, split.value)};
  }
  return {plain, row};
}

}  // namespace

double match_score(std::string_view title, std::string_view words, std::string_view typed) {
  const std::vector<std::string> wanted = words_of(typed), said_by = words_of(title), others = words_of(words);
  if (wanted.empty()) return 0.0;
  std::vector<bool> said(said_by.size(), false);
  double sum = 0.0;
  for (const std::string& word : wanted) {
    const double in_title = best_of(said_by, word, &said), in_words = kSynonym * best_of(others, word, nullptr);
    if (std::max(in_title, in_words) < kLeast) return 0.0;
    sum += std::max(in_title, in_words);
  }
  const auto unsaid = static_cast<double>(std::count(said.begin(), said.end(), false));
  const double score = sum / static_cast<double>(wanted.size()) - kUnsaid * std::min(unsaid, 10.0);
  return score < kLeast ? 0.0 : score;
}

std::vector<PaletteRow> palette_rows(std::span<const Command> commands) {
  std::vector<PaletteRow> out;
  for (const Command& command : commands) {
    const Argument& argument = command.argument;
    // Letters of the name are words by which it is found, too: "live" is in no title.
    const std::string words = command.name + " " + command.words;
    if (argument.kind == ArgumentKind::choice) {
      for (const std::string& choice : argument.choices)
        out.push_back({command.title + (command.title.ends_with(':') ? " " : ": ") + choice,
                       command.name + " " + choice, command.keys, words, choice == argument.value ? "now" : ""});
      continue;
    }
    const bool complete = argument.kind == ArgumentKind::none || argument.kind == ArgumentKind::on_off;
    std::string value = argument.kind == ArgumentKind::none ? "" : argument.value;
    if (!complete) value += (value.empty() ? "" : ", ") + argument.shown;
    out.push_back({command.title, command.name, command.keys, words, value, complete, argument.kind});
  }
  return out;
}

std::vector<PaletteRow> matching_rows(const std::vector<PaletteRow>& rows, std::string_view typed) {
  while (!typed.empty() && typed.front() == ' ') typed.remove_prefix(1);
  while (!typed.empty() && typed.back() == ' ') typed.remove_suffix(1);
  if (typed.empty()) return rows;
  std::vector<std::pair<double, PaletteRow>> found;
  for (const PaletteRow& row : rows) {
    auto one = scored(row, typed);
    if (one.first > 0.0) found.push_back(std::move(one));
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<PaletteRow> out;
  out.reserve(found.size());
  for (auto& one : found) out.push_back(std::move(one.second));
  return out;
}

}  // namespace tangent
