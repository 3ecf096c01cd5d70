#include "workbench/cli/tune_kept.h"

#include "workbench/cli/count_text.h"
#include "workbench/cli/messages.h"

namespace tangent {

TuneKept::TuneKept(const std::filesystem::path& out) {
  std::error_code error;
  if (!std::filesystem::exists(out, error) || std::filesystem::is_regular_file(out, error))
    path_ = std::filesystem::path(out) += ".tuning";
}

Status TuneKept::open(const std::string& digest) {
  if (path_.empty()) return {};
  auto file = sweep::TuningFile::open(path_, digest);
  if (!file) return tl::unexpected(file.error());
  file_ = std::move(*file);
  if (file_->found() > 0)
    print_message("tune",
                  "goes on from " + path_.string() + ", which keeps " + count_text(file_->found(), "trial", "trials"));
  return {};
}

}  // namespace tangent
