#include "workbench/cli/refuse.h"

#include <system_error>

namespace tangent {

void refuse_failed(const std::string& option, const Status& status) {
  if (status) return;
  Error error = status.error();
  error.where.clear();
  refuse_option(option, error.message());
}

void refuse_same_file(const std::string& option, const std::filesystem::path& output, const std::string& read_as,
                      const std::filesystem::path& input) {
  std::error_code error;
  if (!input.empty() && (input == output || std::filesystem::equivalent(input, output, error)))
    refuse_option(option, "names the same file as " + read_as);
}

}  // namespace tangent
