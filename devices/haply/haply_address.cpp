#include "devices/haply/haply_address.h"

#include "devices/haply/haply_problem.h"

#include <algorithm>

namespace tangent {

namespace {

bool is_this_machine(const std::string& host) {
  if (host == "localhost" || host == "::1") return true;
  const auto digit_or_dot = [](char c) { return (c >= '0' && c <= '9') || c == '.'; };
  return host.starts_with("127.") && std::all_of(host.begin(), host.end(), digit_or_dot);
}

bool is_port(const std::string& port) {
  const bool digits = std::all_of(port.begin(), port.end(), [](char c) { return c >= '0' && c <= '9'; });
  return digits && !port.empty() && port.size() <= 5 && std::stoi(port) >= 1 && std::stoi(port) <= 65535;
}

bool is_host(const std::string& host, bool bracketed) {
  const auto fits = [bracketed](char c) {
    const bool word = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    return word || c == '.' || (bracketed ? c == ':' : c == '-' || c == '_');
  };
  return !host.empty() && host.size() <= 253 && std::all_of(host.begin(), host.end(), fits);
}

}  // namespace

Result<HaplyAddress> read_haply_address(const std::string& text, bool other_host) {
  const auto refuse = [&](HaplyProblem why) { return tl::unexpected(haply_error(why, "--haply-address " + text)); };
  constexpr std::string_view kScheme = "ws://";
  if (!text.starts_with(kScheme)) return refuse(HaplyProblem::address);
  std::string rest = text.substr(kScheme.size());
  if (rest.ends_with('/')) rest.pop_back();
  HaplyAddress out{.host = {}, .port = "10001"};
  const bool bracketed = rest.starts_with('[');
  const std::size_t end = bracketed ? rest.find(']') : rest.find(':');
  if (bracketed && end == std::string::npos) return refuse(HaplyProblem::address);
  out.host = bracketed ? rest.substr(1, end - 1) : rest.substr(0, end);
  const std::string after = end == std::string::npos ? "" : rest.substr(bracketed ? end + 1 : end);
  if (!after.empty()) out.port = after.front() == ':' ? after.substr(1) : "";
  if (!is_host(out.host, bracketed) || !is_port(out.port)) return refuse(HaplyProblem::address);
  if (!other_host && !is_this_machine(out.host)) return refuse(HaplyProblem::other_host);
  return out;
}

}  // namespace tangent
