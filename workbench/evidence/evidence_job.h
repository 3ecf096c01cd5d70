// A preset's evidence checked or gathered in a background thread. The owner's thread calls all of it, take() once a
// frame.
#pragma once

#include "workbench/evidence/check_preset.h"

#include <atomic>
#include <memory>
#include <optional>
#include <thread>
#include <variant>
#include <vector>

namespace tangent {

/// What a job was asked for: the outcome of a check, or the preset with evidence.
using EvidenceDone = std::variant<PresetCheck, Result<PresetFile>>;

class EvidenceJob {
 public:
  ~EvidenceJob();

  /// Each cancels what runs. `folder`: of the preset. `threaded` false: within this call.
  void check(PresetFile file, std::filesystem::path folder, bool threaded);
  void attach(PresetFile file, PresetEvidence asked, std::filesystem::path folder, bool threaded);
  /// At once: what the thread still does is thrown away.
  void cancel();
  bool running() const { return work_ != nullptr; }
  /// The result, once.
  std::optional<EvidenceDone> take();

 private:
  struct Work {
    std::atomic<bool> stop{false}, done{false};
    std::optional<EvidenceDone> result;  ///< of the worker until `done`
    std::thread thread;
  };
  template <class Do>
  void start(Do what, bool threaded);
  void forget_ended();

  std::shared_ptr<Work> work_;
  std::vector<std::shared_ptr<Work>> cancelled_;  ///< that have not ended yet
};

}  // namespace tangent
