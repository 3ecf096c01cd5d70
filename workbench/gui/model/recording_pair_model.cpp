#include "workbench/gui/model/recording_pair_model.h"

#include <algorithm>
#include <utility>

namespace tangent {

namespace {

constexpr std::uint64_t kAround = 250;  ///< ticks before and after the largest difference

}  // namespace

void RecordingPairModel::compare() {
  if (first.empty()) return messages_.refuse("name the first recording to compare");
  chosen_.reset();
  start({first, second, presets_.current(), by});
}

RecordingPairModel::~RecordingPairModel() {
  stop();
  for (const auto& job : jobs_)
    if (job->thread.joinable()) job->thread.join();
}

void RecordingPairModel::stop() {
  const std::scoped_lock lock(guard_);
  for (const auto& job : jobs_) job->cancelled = true;
}

bool RecordingPairModel::running() const { return !jobs_.empty() && !jobs_.back()->done && !jobs_.back()->cancelled; }

void RecordingPairModel::start(RecordingsAsked asked) {
  stop();
  asked_ = std::move(asked);
  jobs_.push_back(std::make_unique<Job>());
  Job& job = *jobs_.back();
  job.asked = asked_;
  if (!threaded_) return work(job);
  job.thread = std::thread([this, &job] { work(job); });
}

void RecordingPairModel::work(Job& job) {
  const RecordingsAsked& asked = job.asked;
  CompareRecordingsOptions options;
  options.by = asked.by;
  options.from = asked.from;
  options.to = asked.to;
  options.cancelled = [&job] { return job.cancelled.load(); };
  if (asked.second.empty()) {
    put(job, compare_under(asked.first, {.other = [&asked](const Preset&) { return asked.preset; }}, options));
  } else {
    const bool all = asked.to == std::numeric_limits<std::uint64_t>::max();
    if (all) put(job, compare_coarsely(asked.first, asked.second, options));
    if (!job.cancelled) put(job, compare_fully(asked.first, asked.second, options));
  }
  job.done = true;
}

void RecordingPairModel::put(const Job& job, Result<RecordingsCompared> found) {
  const std::scoped_lock lock(guard_);
  if (job.cancelled) return;
  if (!found) {
    failure_ = found.error().message();
    return;
  }
  result_ = std::make_shared<const RecordingsCompared>(std::move(*found));
  first_of_result_ = job.asked.first;
  second_of_result_ = job.asked.second;
}

std::shared_ptr<const RecordingsCompared> RecordingPairModel::result() const {
  const std::scoped_lock lock(guard_);
  return result_;
}

void RecordingPairModel::update() {
  std::erase_if(jobs_, [](const std::unique_ptr<Job>& job) {
    if (!job->done) return false;
    if (job->thread.joinable()) job->thread.join();
    return true;
  });
  std::string said;
  {
    const std::scoped_lock lock(guard_);
    said = std::exchange(failure_, {});
  }
  if (!said.empty()) messages_.say(Severity::error, said);
}

/// Of the channel that is drawn; null: they do not differ in it.
const ComparedBin* RecordingPairModel::largest_bin(const RecordingsCompared& found) const {
  const ComparedBin* largest = nullptr;
  for (const ComparedBin& bin : found.bins)
    if (bin.ticks > 0 && (largest == nullptr || bin.at_most[channel] > largest->at_most[channel])) largest = &bin;
  return largest != nullptr && largest->at_most[channel] > 0.0 ? largest : nullptr;
}

Result<RecordedPlace> RecordingPairModel::place(bool in_second) const {
  const auto found = result();
  if (found == nullptr) return fail("no recordings are compared yet", {}, "compare two");
  if (!found->alignment.aligned())
    return fail("no tick of one goes with one of the other: " + found->alignment.why_not);
  const std::scoped_lock lock(guard_);
  if (in_second && second_of_result_.empty())
    return fail("the second is the first one's motion under the present values", {},
                "look at it in the first: a value that is changed there is drawn beside it");
  const ComparedBin* largest = largest_bin(*found);
  const std::uint64_t tick = std::clamp(chosen_              ? *chosen_
                                        : largest != nullptr ? largest->first
                                                             : 0,
                                        found->alignment.first, found->alignment.last);
  if (in_second) return RecordedPlace{second_of_result_, found->alignment.in_b(tick)};
  return RecordedPlace{first_of_result_, tick};
}

bool RecordingPairModel::go_to_largest() {
  const auto found = result();
  const ComparedBin* largest = found != nullptr ? largest_bin(*found) : nullptr;
  if (largest == nullptr) {
    messages_.refuse("no difference to go to");
    return false;
  }
  RecordingsAsked asked = asked_;
  asked.from = largest->first > kAround ? largest->first - kAround : 0;
  asked.to = largest->first + std::max<std::uint64_t>(largest->ticks, 1) + kAround;
  start(std::move(asked));
  return true;
}

void RecordingPairModel::show_whole() {
  if (asked_.first.empty()) return;
  RecordingsAsked asked = asked_;
  asked.from = 0;
  asked.to = std::numeric_limits<std::uint64_t>::max();
  start(std::move(asked));
}

}  // namespace tangent
