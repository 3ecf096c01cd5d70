// The tick in view: its record, and its iterations from stepping it again with a trace. A copy, so that it stays valid
// when the history advances.
#pragma once

#include "workbench/session/session.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>

namespace tangent {

class TickView {
 public:
  const ServoRecord* record() const { return record_ ? &*record_ : nullptr; }
  /// [0] is the kept plane. Empty when the tick could not be stepped again.
  std::span<const IterationRecord> iterations() const { return trace_->view(); }
  std::size_t iterations_lost() const { return trace_->lost; }
  /// Why the tick could not be stepped again; empty when it could, or when there is no tick.
  const std::string& problem() const { return problem_; }

  std::optional<std::size_t> selected() const { return selected_; }
  void select(std::optional<std::size_t> i) {
    selected_ = i;
    if (selected_ && *selected_ >= trace_->size) selected_.reset();
  }

  void clear() {
    record_.reset();
    trace_->clear();
    selected_.reset();
    problem_.clear();
  }

  /// Steps the record's tick again, unless it is the one already shown.
  /// `solve`: (record, trace) to Result<TickOutput>.
  template <class Solve>
  void show(const ServoRecord& record, const Solve& solve) {
    if (record_ && record_->tick.tick == record.tick.tick && record_->tick.input.t_s == record.tick.input.t_s) return;
    record_ = record;
    trace_->clear();
    selected_.reset();
    problem_.clear();
    if (const auto output = solve(record, *trace_); !output) {
      trace_->clear();
      problem_ = output.error().message();
    }
  }

 private:
  std::optional<ServoRecord> record_;
  std::unique_ptr<IterationTrace> trace_ = std::make_unique<IterationTrace>();
  std::optional<std::size_t> selected_;
  std::string problem_;
};

}  // namespace tangent
