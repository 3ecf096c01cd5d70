// Writes ticks into a file of some format: one class for each.
#pragma once

#include "workbench/recording/exported_columns.h"

#include <filesystem>
#include <functional>
#include <memory>

namespace tangent {

struct RecordingInfo;

class Exporter {
 public:
  virtual ~Exporter() = default;
  virtual Status add(RecordedTick& tick) = 0;
  /// Puts the file in place. Call once, last; without it nothing is left.
  virtual Status commit() = 0;
};

struct ExportTarget {
  const std::filesystem::path& from;
  const std::filesystem::path& to;
  const RecordingInfo& info;  ///< of the recording
  const std::function<bool()>& cancelled;
};

Result<std::unique_ptr<Exporter>> csv_exporter(const ExportTarget& target, std::vector<ExportedColumn> columns);
Result<std::unique_ptr<Exporter>> mcap_exporter(const ExportTarget& target, std::vector<ExportedColumn> columns);
/// Fails where the program was built without libmatio.
Result<std::unique_ptr<Exporter>> mat_exporter(const ExportTarget& target, std::vector<ExportedColumn> columns);
bool has_mat_files();

}  // namespace tangent
