#include "core/io/atomic_file.h"
#include "workbench/recording/exporter.h"

namespace tangent {
namespace {

class CsvExporter final : public Exporter {
 public:
  CsvExporter(AtomicFile file, std::vector<ExportedColumn> columns)
      : file_(std::move(file)), columns_(std::move(columns)) {}
  Status add(RecordedTick& tick) override {
    line_.clear();
    if (first_)
      for (const ExportedColumn& column : columns_) line_ += column.name + (&column == &columns_.back() ? "\n" : ",");
    first_ = false;
    for (const ExportedColumn& column : columns_) {
      append_value(line_, column, tick);
      line_ += &column == &columns_.back() ? '\n' : ',';
    }
    return file_.write(line_);
  }
  Status commit() override { return file_.commit(); }

 private:
  AtomicFile file_;
  std::vector<ExportedColumn> columns_;
  std::string line_;
  bool first_ = true;
};

}  // namespace

Result<std::unique_ptr<Exporter>> csv_exporter(const ExportTarget& target, std::vector<ExportedColumn> columns) {
  Result<AtomicFile> file = AtomicFile::create(target.to);
  if (!file) return tl::unexpected(file.error());
  return std::make_unique<CsvExporter>(std::move(*file), std::move(columns));
}

}  // namespace tangent
