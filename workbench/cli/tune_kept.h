// What a tuning has tried, in a file beside its preset while it runs: killed, the same command goes on from there.
#pragma once

#include "workbench/sweep/tuning_file.h"

namespace tangent {

class TuneKept {
 public:
  /// "F.toml.tuning". Nothing is kept beside what is no file: /dev/stdout.
  explicit TuneKept(const std::filesystem::path& out);
  /// Says so where it goes on with what was tried before.
  Status open(const std::string& digest);
  sweep::TuningFile* file() const { return file_.get(); }  ///< null: nothing is kept
  bool failed() const { return file_ != nullptr && file_->failed(); }
  Status status() const { return file_ != nullptr ? file_->status() : Status{}; }
  void remove() {
    if (file_ != nullptr) file_->remove();
  }

 private:
  std::filesystem::path path_;
  std::unique_ptr<sweep::TuningFile> file_;
};

}  // namespace tangent
