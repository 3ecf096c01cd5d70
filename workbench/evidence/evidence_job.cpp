#include "workbench/evidence/evidence_job.h"

#include "workbench/evidence/attach_evidence.h"

#include <algorithm>
#include <utility>

namespace tangent {

EvidenceJob::~EvidenceJob() {
  cancel();
  for (const std::shared_ptr<Work>& work : cancelled_) work->thread.join();
}

template <class Do>
void EvidenceJob::start(Do what, bool threaded) {
  cancel();
  work_ = std::make_shared<Work>();
  const auto run = [work = work_.get(), what = std::move(what)] {
    work->result = what([work] { return !work->stop.load(); });
    work->done.store(true);
  };
  if (threaded)
    work_->thread = std::thread(run);
  else
    run();
}

void EvidenceJob::check(PresetFile file, std::filesystem::path folder, bool threaded) {
  start(
      [file = std::move(file), folder = std::move(folder)](std::function<bool()> keep_going) {
        auto check = check_preset_evidence(file, {folder, false, std::move(keep_going)});
        return check ? std::optional<EvidenceDone>(std::move(*check)) : std::nullopt;
      },
      threaded);
}

void EvidenceJob::attach(PresetFile file, PresetEvidence asked, std::filesystem::path folder, bool threaded) {
  start(
      [file = std::move(file), asked = std::move(asked),
       folder = std::move(folder)](std::function<bool()> keep_going) -> std::optional<EvidenceDone> {
        auto attached = attach_evidence(file, asked, {folder, false, std::move(keep_going)});
        if (!attached) return Result<PresetFile>(tl::unexpected(attached.error()));
        if (!*attached) return std::nullopt;
        return Result<PresetFile>(std::move(**attached));
      },
      threaded);
}

void EvidenceJob::cancel() {
  if (work_ == nullptr) return;
  work_->stop.store(true);
  if (work_->thread.joinable()) cancelled_.push_back(work_);
  work_ = nullptr;
}

std::optional<EvidenceDone> EvidenceJob::take() {
  forget_ended();
  if (work_ == nullptr || !work_->done.load()) return std::nullopt;
  if (work_->thread.joinable()) work_->thread.join();
  return std::exchange(work_, nullptr)->result;
}

void EvidenceJob::forget_ended() {
  std::erase_if(cancelled_, [](const std::shared_ptr<Work>& work) {
    if (!work->done.load()) return false;
    work->thread.join();
    return true;
  });
}

}  // namespace tangent
