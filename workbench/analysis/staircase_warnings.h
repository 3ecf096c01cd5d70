// What is wrong with a single staircase, in words: a number that looks like a threshold and is none.
#pragma once

#include "workbench/experiment/staircase.h"

#include <span>
#include <string>
#include <vector>

namespace tangent::analysis {

struct StaircaseResult;

/// That it did not settle; that half of the averaged reversals lie at the fewest or most segments that can be shown, so
/// that its threshold may lie beyond; that its fit does; that right answers are no more than guessing gives in one of
/// twenty (one-sided binomial test). Empty: nothing of it.
std::vector<std::string> staircase_warnings(const StaircaseResult& staircase, const experiment::StaircaseRule& rule);

/// Probability of at least `right` of `count` answers by guessing between two.
double guessing_probability(int right, int count);

}  // namespace tangent::analysis
