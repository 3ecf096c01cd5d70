#include "workbench/bringup/bring_up_protocol.h"

#include "core/io/atomic_file.h"
#include "workbench/bringup/bring_up_text.h"

#include <nlohmann/json.hpp>

#include <ctime>

namespace tangent {
namespace {

using Json = nlohmann::json;

constexpr int kFormat = 1;

Json numbers(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

Json stop_json(const StopFacts& s) {
  return {{"force_n", s.force_n}, {"held_m", s.held_m}, {"left_m", s.left_m}, {"ticks_to_zero", s.ticks_to_zero}};
}

Json facts_json(const BringUpFacts& f) {
  Json out{{"rest",
            {{"seconds", f.rest.seconds},
             {"noise_rms_m", numbers(f.rest.noise_m)},
             {"range_m", f.rest.range_m},
             {"ticks", f.rest.ticks}}},
           {"smallest_step_m", f.smallest_step_m},
           {"rate",
            {{"hz", f.rate.hz},
             {"mean_age_s", f.rate.mean_age_s},
             {"oldest_s", f.rate.oldest_s},
             {"ticks", f.rate.ticks},
             {"lost", f.rate.lost},
             {"late", f.rate.late}}},
           {"stop", stop_json(f.stop)},
           {"watchdog", stop_json(f.watchdog)},
           {"emergency", stop_json(f.emergency)}};
  constexpr const char* kMotions[] = {"away", "right", "up"};
  for (std::size_t i = 0; i < 3; ++i)
    out["motions"].push_back({{"asked", kMotions[i]},
                              {"moved_m", numbers(f.motions[i].moved_m)},
                              {"verdict", to_string(f.motions[i].verdict)}});
  out["pushes"] = Json::array();
  for (std::size_t i = 0; i < f.push_count; ++i) {
    const PushFacts& p = f.pushes[i];
    out["pushes"].push_back({{"axis", p.axis},
                             {"force_n", p.force_n},
                             {"moved_m", numbers(p.moved_m)},
                             {"seen_m", p.seen_m},
                             {"encoders_agree", p.measured_right},
                             {"person_agrees", p.said_right}});
  }
  return out;
}

std::string why_of(const BringUpProtocol& p, BringUpStep step) {
  if (!p.opening.what.empty() && p.result.verdict(step) == StepVerdict::failed) return p.opening.message();
  std::string why = step_why_text(step, p.result, p.device);
  if (step == BringUpStep::cable && !why.empty() && !p.cable.empty()) why += " (" + p.cable + ")";
  return why;
}

Json device_json(const ForceCapabilities& c) {
  return {{"name", c.name},
          {"serial", c.serial},
          {"simulated", c.simulated},
          {"pushes_along", pushed_axes(c)},
          {"peak_force_n", c.peak_force_n},
          {"continuous_force_n", c.continuous_force_n},
          {"position_resolution_m", c.position_resolution_m},
          {"workspace_half_size_m", numbers(c.workspace_half_size_m)},
          {"rate_hz", c.rate_hz},
          {"firmware_timeout_s", c.firmware_timeout_s},
          {"frame", frame_text(c.frame)}};
}

}  // namespace

BringUpProtocol unopened_protocol(const std::string& kind, const ForceCapabilities& device, const Error& why,
                                  bool attached) {
  BringUpProtocol p;
  p.kind = kind;
  p.device = device;
  p.opening = why;
  p.result.ended = true;
  p.result.verdicts[0] = attached ? StepVerdict::proved : StepVerdict::failed;
  if (attached) p.result.verdicts[1] = StepVerdict::failed;
  p.result.step = attached ? BringUpStep::permission : BringUpStep::cable;
  return p;
}

std::string protocol_json(const BringUpProtocol& p) {
  Json out{{"format", kFormat},
           {"kind", p.kind},
           {"date", p.date},
           {"program", p.program},
           {"limit_n", p.most_n},
           {"device", device_json(p.device)},
           {"steps", Json::array()},
           {"measured", facts_json(p.result.facts)},
           {"all_proved", p.result.all_proved()},
           {"not_proved", not_proved_lines(p.result, p.device)}};
  for (std::size_t i = 0; i < kBringUpSteps; ++i) {
    const auto step = static_cast<BringUpStep>(i);
    Json entry{{"step", step_word(step)}, {"verdict", to_string(p.result.verdicts[i])}};
    if (const std::string facts = step_facts_text(step, p.result, p.device); !facts.empty()) entry["facts"] = facts;
    if (const std::string why = why_of(p, step); !why.empty()) entry["why"] = why;
    out["steps"].push_back(std::move(entry));
  }
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string protocol_page(const BringUpProtocol& p) {
  std::string text = "# Bring-up of " + p.device.name + "\n\n" +
                     (p.device.simulated ? "**A simulated device: this proves nothing about a real one.**\n\n" : "") +
                     "| | |\n|---|---|\n| driver | `" + p.kind + "` |\n| serial number | " +
                     (p.device.serial.empty() ? "not known" : p.device.serial) + " |\n| date | " + p.date +
                     " |\n| program | Tangent Workbench " + p.program + " |\n| result | " +
                     (p.result.all_proved() ? "all proved" : "not all proved") + " |\n\n" +
                     "| step | verdict | measured |\n|---|---|---|\n";
  for (std::size_t i = 0; i < kBringUpSteps; ++i) {
    const auto step = static_cast<BringUpStep>(i);
    const std::string why = why_of(p, step), facts = step_facts_text(step, p.result, p.device);
    text += std::string("| ") + step_title(step) + " | " + to_string(p.result.verdicts[i]) + " | " + facts +
            (facts.empty() || why.empty() ? "" : ": ") + why + " |\n";
  }
  text += "\nNot proved:\n\n";
  for (const std::string& line : not_proved_lines(p.result, p.device)) text += "- " + line + "\n";
  return text;
}

Status write_protocol(const BringUpProtocol& protocol, const std::filesystem::path& file) {
  std::filesystem::path page = file;
  page.replace_extension(".md");
  if (page == file) return fail("ends with .md, which is the page beside it", file.string(), "call it F.json");
  if (const Status written = write_file_atomic(file, protocol_json(protocol)); !written) return written;
  return write_file_atomic(page, protocol_page(protocol));
}

std::string protocol_date() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

}  // namespace tangent
