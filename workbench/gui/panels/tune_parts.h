// Parts of the section Tune: its plots, its table, and what one does with a trial.
#pragma once

#include "workbench/gui/panels/panels.h"

namespace tangent {

/// Objectives, constraints, values with their ranges, motion and number of trials, each to be changed.
void draw_tune_question(const UiContext& ui, AppModel& model);
/// Two scatters of the trials: objectives with the front, and keys with what theory names; and what their marks mean.
/// Precondition: there are trials.
void draw_tune_plots(const UiContext& ui, AppModel& model, TunePanel& state);
/// The brushed trials, without a brush the front. A click tries one.
void draw_tune_table(const UiContext& ui, AppModel& model);
/// What a trial is: its numbers and values, a line each.
std::string trial_text(const TuneModel& tune, std::size_t trial);
/// Small text over the column's width.
void draw_tune_text(const UiContext& ui, const std::string& text, ImU32 ink);

}  // namespace tangent
