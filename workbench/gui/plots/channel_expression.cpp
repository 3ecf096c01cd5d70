#include "workbench/gui/plots/channel_expression.h"

#include "core/base/text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace tangent {
namespace {

struct Operation {
  std::string_view key;
  Derivation how;
  std::size_t least, most;  ///< operands
};
constexpr std::array kOperations{
    Operation{"difference", Derivation::difference, 2, 2}, Operation{"derivative", Derivation::derivative, 1, 1},
    Operation{"low_pass", Derivation::low_pass, 1, 1}, Operation{"magnitude", Derivation::magnitude, 2, 3}};
constexpr double kLowestCutoff_hz = 0.01, kHighestCutoff_hz = 1e4;
constexpr std::size_t kMostCharacters = 400;  // characters

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

/// At the commas that are in no parentheses.
std::vector<std::string_view> operands_of(std::string_view text) {
  std::vector<std::string_view> parts;
  int depth = 0;
  std::size_t from = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i < text.size() && text[i] == '(') ++depth;
    if (i < text.size() && text[i] == ')') --depth;
    if (i < text.size() && (text[i] != ',' || depth != 0)) continue;
    parts.push_back(trimmed(text.substr(from, i - from)));
    from = i + 1;
  }
  return parts;
}

tl::unexpected<Error> refused(std::string what, std::string_view text) {
  return fail(std::move(what), "\"" + std::string(text) + "\"",
              "write as in: force_x, difference(force_x, force_z), derivative(error), low_pass(force_x, 20 Hz), "
              "magnitude(force_x, force_y)");
}

/// The cut-off, taken off the operands.
Result<double> cutoff_of(std::vector<std::string_view>& parts, std::string_view text) {
  if (parts.size() != 2) return refused("a low-pass filter needs a channel and a cut-off frequency", text);
  std::string_view number = parts.back();
  parts.pop_back();
  if (number.ends_with("Hz")) number = trimmed(number.substr(0, number.size() - 2));
  const std::optional<double> hz = parse_finite_double(number);
  if (!hz || *hz < kLowestCutoff_hz || *hz > kHighestCutoff_hz)
    return refused("the cut-off is to be from 0.01 to 10000 Hz", text);
  return *hz;
}

Result<ChannelExpression> parsed(std::string_view text, const ChannelOfKey& channel_of, int depth) {
  text = trimmed(text);
  const std::size_t open = text.find('(');
  if (open == std::string_view::npos) {
    const std::optional<std::size_t> channel = channel_of(text);
    if (!channel) return refused("there is no such channel", text);
    return ChannelExpression{.channel = *channel, .of = {}};
  }
  const auto operation =
      std::find_if(kOperations.begin(), kOperations.end(),
                   [key = trimmed(text.substr(0, open))](const Operation& o) { return o.key == key; });
  if (operation == kOperations.end() || text.back() != ')') return refused("is no channel", text);
  if (depth == 0) return refused("has too many operations inside each other", text);
  std::vector<std::string_view> parts = operands_of(text.substr(open + 1, text.size() - open - 2));
  ChannelExpression out{.how = operation->how, .of = {}};
  if (out.how == Derivation::low_pass) {
    const Result<double> cutoff = cutoff_of(parts, text);
    if (!cutoff) return tl::unexpected(cutoff.error());
    out.cutoff_hz = *cutoff;
  }
  if (parts.size() < operation->least || parts.size() > operation->most)
    return refused(std::string(operation->key) + " takes " + std::to_string(operation->least) +
                       (operation->most > operation->least ? " or " + std::to_string(operation->most) : "") +
                       (operation->most > 1 ? " channels" : " channel"),
                   text);
  for (const std::string_view part : parts) {
    Result<ChannelExpression> operand = parsed(part, channel_of, depth - 1);
    if (!operand) return operand;
    out.of.push_back(std::move(*operand));
  }
  return out;
}

}  // namespace

Result<ChannelExpression> parse_channel(std::string_view text, const ChannelOfKey& channel_of) {
  if (text.size() > kMostCharacters) return refused("is too long for a channel", text.substr(0, 40));
  return parsed(text, channel_of, kDeepest);
}

std::string written(const ChannelExpression& expression, const std::function<std::string(std::size_t)>& key_of) {
  if (expression.how == Derivation::none) return key_of(expression.channel);
  std::string text;
  for (const Operation& operation : kOperations)
    if (operation.how == expression.how) text = operation.key;
  text += '(';
  for (const ChannelExpression& operand : expression.of)
    text += (text.back() == '(' ? "" : ", ") + written(operand, key_of);
  if (expression.how == Derivation::low_pass) {
    text += ", ";
    append_double(text, expression.cutoff_hz);
    text += " Hz";
  }
  return text + ')';
}

std::optional<ChannelExpression> over_channels(ChannelExpression expression,
                                               const std::function<std::optional<std::size_t>(std::size_t)>& other_of) {
  if (expression.how == Derivation::none) {
    const std::optional<std::size_t> other = other_of(expression.channel);
    if (!other) return std::nullopt;
    expression.channel = *other;
  }
  for (ChannelExpression& operand : expression.of) {
    std::optional<ChannelExpression> other = over_channels(std::move(operand), other_of);
    if (!other) return std::nullopt;
    operand = std::move(*other);
  }
  return expression;
}

}  // namespace tangent
