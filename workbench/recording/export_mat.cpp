// A MATLAB file has one variable after the other, and a recording one tick after the other: the columns wait in a file
// of their own, and one of them at a time is in memory.
#include "core/io/atomic_file.h"
#include "workbench/recording/column_spool.h"
#include "workbench/recording/exporter.h"
#include "workbench/recording/matio/mat_module.h"
#include "workbench/recording/recording.h"

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <limits>
#include <system_error>

#include <dlfcn.h>

namespace tangent {
namespace {

constexpr std::uint64_t kMostRows = (std::uint64_t{1} << 31) / 8 - 4096;  // a variable has 2 GiB at most
constexpr const char* kWriteRemedy = "check that the directory is writable and has room";

/// Of the module that was built with libmatio; null: there is none.
const MatFunctions* mat_functions() {
#ifdef TANGENT_MATIO_MODULE
  static void* const module = ::dlopen(TANGENT_MATIO_MODULE, RTLD_NOW | RTLD_LOCAL);
  static const auto get = reinterpret_cast<const MatFunctions* (*)()>(
      module != nullptr ? ::dlsym(module, "tangent_mat_functions") : nullptr);
  return get != nullptr ? get() : nullptr;
#else
  return nullptr;
#endif
}

MatType type_of(const ExportedColumn& column) {
  if (column.real != nullptr) return MatType::real;
  if (column.whole == nullptr) return MatType::u64;
  const std::int64_t least = column.whole->least, most = column.whole->most;
  if (least < 0) return most <= std::numeric_limits<std::int32_t>::max() ? MatType::i32 : MatType::i64;
  return most <= std::numeric_limits<std::uint8_t>::max() ? MatType::u8 : MatType::u32;
}

std::uint64_t value_of(const ExportedColumn& column, RecordedTick& tick) {
  if (column.real != nullptr) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return std::bit_cast<std::uint64_t>(is_absent(column, tick) ? none : column.real->at(tick));
  }
  return column.whole != nullptr ? static_cast<std::uint64_t>(column.whole->get(tick)) : tick.record.tick.tick;
}

/// From 8 bytes a value to those of its type, in place.
template <class T>
void narrow_to(std::vector<std::uint64_t>& values) {
  auto* const to = reinterpret_cast<char*>(values.data());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const T narrow = static_cast<T>(values[i]);
    std::copy_n(reinterpret_cast<const char*>(&narrow), sizeof narrow, to + i * sizeof narrow);
  }
}

void narrow(MatType type, std::vector<std::uint64_t>& values) {
  if (type == MatType::u8) narrow_to<std::uint8_t>(values);
  if (type == MatType::u32) narrow_to<std::uint32_t>(values);
  if (type == MatType::i32) narrow_to<std::int32_t>(values);
}

/// libmatio does not say that a disk was full. A header of 128 bytes, then the variables: each begins with its type,
/// 14, and its length.
bool is_complete(const std::filesystem::path& path, std::size_t variables) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  std::uint64_t at = 128;
  for (; variables > 0 && at < size; --variables) {
    std::array<std::uint32_t, 2> type_and_length{};
    file.seekg(static_cast<std::streamoff>(at));
    file.read(reinterpret_cast<char*>(type_and_length.data()), sizeof type_and_length);
    if (!file || type_and_length[0] != 14) return false;
    at += sizeof type_and_length + type_and_length[1];
  }
  return !error && variables == 0 && at == size;
}

/// MATLAB counts characters of 16 bits: of what is not ASCII a question mark is left.
std::string ascii(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) > 126; }, '?');
  return text;
}

MatAbout about(const ExportTarget& target, const std::vector<ExportedColumn>& columns) {
  MatAbout out;
  out.texts = {{"recording", ascii(target.from.filename().string())},
               {"started_utc", ascii(target.info.started_utc)},
               {"recorded_by", ascii("tangent-workbench " + target.info.version)},
               {"exported_by", "tangent-workbench " TANGENT_VERSION}};
  for (const ExportedColumn& column : columns) {
    out.units.emplace_back(column.name, unit_of(column.name));
    out.meanings.emplace_back(column.name, ascii(column.meaning));
    if (!column.is_word()) continue;
    std::vector<std::string> words;
    for (std::int64_t code = 0; code <= column.whole->most; ++code) words.emplace_back(column.whole->word(code));
    out.words.emplace_back(column.name, std::move(words));
  }
  return out;
}

class MatExporter final : public Exporter {
 public:
  MatExporter(const MatFunctions& mat, const ExportTarget& target, AtomicFile file, ColumnSpool spool,
              std::vector<ExportedColumn> columns)
      : mat_(mat),
        file_(std::move(file)),
        spool_(std::move(spool)),
        columns_(std::move(columns)),
        about_(about(target, columns_)),
        cancelled_(target.cancelled) {}

  Status add(RecordedTick& tick) override {
    if (spool_.rows() >= kMostRows)
      return fail("has more than " + std::to_string(kMostRows) + " ticks, which is as many as a MATLAB file holds",
                  file_.path().string(), "export a part of them, with --from and --to");
    row_.clear();
    for (const ExportedColumn& column : columns_) row_.push_back(value_of(column, tick));
    return spool_.add(row_);
  }

  Status commit() override {
    void* const mat = mat_.create(file_.being_written().c_str(), "Ticks of a recording, by Tangent Workbench");
    if (mat == nullptr) return fail("cannot be written", file_.path().string(), kWriteRemedy);
    Status done = mat_.put_about(mat, about_) ? Status{} : failure();
    for (std::size_t i = 0; done && i < columns_.size(); ++i) done = put_column(mat, i);
    if (!mat_.close(mat) && done) done = failure();
    if (done && !is_complete(file_.being_written(), columns_.size() + 1)) done = failure();
    return done ? file_.commit() : done;
  }

 private:
  Status put_column(void* mat, std::size_t i) {
    if (cancelled_()) return fail("was interrupted", file_.path().string(), "nothing is left of it");
    if (Status ok = spool_.read(i, values_); !ok) return ok;
    const MatType type = type_of(columns_[i]);
    narrow(type, values_);
    const bool put = mat_.put_numbers(mat, {columns_[i].name.c_str(), type, values_.data(), values_.size()});
    return put ? Status{} : failure();
  }

  tl::unexpected<Error> failure() const {
    return fail("could not be written whole", file_.path().string(), kWriteRemedy);
  }

  const MatFunctions& mat_;
  AtomicFile file_;
  ColumnSpool spool_;
  std::vector<ExportedColumn> columns_;
  MatAbout about_;
  const std::function<bool()>& cancelled_;
  std::vector<std::uint64_t> row_, values_;
};

}  // namespace

bool has_mat_files() { return mat_functions() != nullptr; }

Result<std::unique_ptr<Exporter>> mat_exporter(const ExportTarget& target, std::vector<ExportedColumn> columns) {
  const MatFunctions* const mat = mat_functions();
  if (mat == nullptr)
    return fail("MATLAB files need libmatio, which this program was built without", target.to.string(),
                "install libmatio-dev and build again, or end the name in .csv, which readtable reads");
  Result<AtomicFile> file = AtomicFile::create(target.to);
  if (!file) return tl::unexpected(file.error());
  Result<ColumnSpool> spool = ColumnSpool::create(file->being_written().parent_path(), columns.size(), target.to);
  if (!spool) return tl::unexpected(spool.error());
  return std::make_unique<MatExporter>(*mat, target, std::move(*file), std::move(*spool), std::move(columns));
}

}  // namespace tangent
