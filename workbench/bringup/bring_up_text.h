// A bring-up in words: steps, questions, numbers, reasons. Not in the servo thread.
#pragma once

#include "devices/force_device.h"
#include "workbench/bringup/bring_up_facts.h"

#include <string>
#include <vector>

namespace tangent {

const char* step_title(BringUpStep step);    ///< "Axes and signs"
const char* step_word(BringUpStep step);     ///< "axes": in files
const char* to_string(StepVerdict verdict);  ///< "proved", "not proved", ...

/// What the person is to do, and why it is asked again; empty: nothing.
std::string question_text(const BringUpView& view, const ForceCapabilities& can);
/// What the button or the key "yes" means now: "Push with 0.1 N", "It moved to the right"; empty: nothing is asked.
std::string yes_text(const BringUpView& view, const ForceCapabilities& can);
/// The same of "no"; empty: there is none.
std::string no_text(const BringUpView& view);
/// Whether the question may be left out.
bool may_skip(const BringUpView& view);

/// The numbers of a step; empty: none yet.
std::string step_facts_text(BringUpStep step, const BringUpView& view, const ForceCapabilities& can);
/// Why the step failed, and what to do about it; empty: it didn't.
std::string step_why_text(BringUpStep step, const BringUpView& view, const ForceCapabilities& can);
/// The same of any guided run.
std::string why_text(BringUpWhy why, const ExchangeView& view);
/// What this bring-up leaves open, a line each.
std::vector<std::string> not_proved_lines(const BringUpView& view, const ForceCapabilities& can);

}  // namespace tangent
