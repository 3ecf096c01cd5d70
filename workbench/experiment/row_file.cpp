#include "workbench/experiment/row_file.h"

#include "core/base/fnv.h"
#include "core/io/csv_table.h"
#include "core/io/input_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace tangent::experiment {
namespace {

constexpr std::size_t kMaxTableBytes = std::size_t{1} << 28;
constexpr std::string_view kCheck = "check";

std::string joined(const Fields& fields) {
  std::string out;
  for (const std::string& field : fields) out += field + "\t";
  return out;
}

Fields split(std::string_view line) {
  Fields out;
  for (;;) {
    const std::size_t tab = line.find('\t');
    out.emplace_back(line.substr(0, tab));
    if (tab == std::string_view::npos) return out;
    line.remove_prefix(tab + 1);
  }
}

std::string check_of(std::string_view before, std::string_view text) { return Fnv().add(before).add(text).text(); }

std::string reason() { return std::strerror(errno); }

std::string csv_line(const Fields& fields) {
  std::string out;
  for (const std::string& field : fields) {
    const bool plain = field.find_first_of(",\"\r") == std::string::npos;
    std::string inner;
    for (const char c : field) inner += c == '"' ? "\"\"" : std::string(1, c);
    out += (&field == fields.data() ? "" : ",") + (plain ? field : '"' + inner + '"');
  }
  return out + "\n";
}

struct Table {
  ReadRows read;
  std::size_t whole_bytes = 0;
  std::string last_check;
};

/// `text`: not empty.
Result<Table> parse(std::string_view text, const std::filesystem::path& path, const std::string& identity) {
  Table out;
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos) return out;  // only a torn header
  const std::string_view header = text.substr(0, end);
  out.read.columns = split(header);
  if (out.read.columns.back() != kCheck)
    return fail("is no table of answers: its last column is not \"check\"", path.string() + ":1",
                "give a file that `workbench experiment` wrote");
  out.last_check = check_of(identity, header);
  out.whole_bytes = end + 1;
  std::size_t number = 1;
  for (std::string_view rest = text.substr(end + 1); !rest.empty();) {
    const std::size_t line_end = rest.find('\n');
    if (line_end == std::string_view::npos) break;  // torn
    ++number;
    const std::string where = path.string() + ":" + std::to_string(number);
    Fields fields = split(rest.substr(0, line_end));
    if (fields.size() != out.read.columns.size())
      return fail("has " + std::to_string(fields.size()) + " fields (the header has " +
                      std::to_string(out.read.columns.size()) + ")",
                  where, "use the file as it was written");
    const std::string check = fields.back();
    fields.pop_back();
    if (out.read.complaint.empty() && check != check_of(out.last_check, joined(fields)))
      out.read.complaint = where + ": its checksum does not hold: this row, or one before it, was changed or left out";
    out.last_check = check;
    out.read.rows.push_back(std::move(fields));
    out.whole_bytes += line_end + 1;
    rest.remove_prefix(line_end + 1);
  }
  out.read.columns.pop_back();
  return out;
}

}  // namespace

Result<ReadRows> read_rows(const std::filesystem::path& path, const std::string& identity) {
  const Result<std::string> text = read_input_file(path, kMaxTableBytes);
  if (!text) return tl::unexpected(text.error());
  Result<Table> table = parse(*text, path, identity);
  if (!table) return tl::unexpected(table.error());
  if (table->whole_bytes == 0) return fail("is no table of answers: it has no header", path.string());
  return std::move(table->read);
}

RowFile::RowFile(RowFile&& other) noexcept
    : file_(std::move(other.file_)),
      csv_(std::exchange(other.csv_, -1)),
      last_check_(std::move(other.last_check_)),
      rows_(std::move(other.rows_)),
      added_(other.added_) {}

RowFile::~RowFile() {
  if (csv_ >= 0) ::close(csv_);
}

Result<RowFile> RowFile::open(const std::filesystem::path& path, const Fields& columns, const std::string& identity) {
  Result<AppendedFile> file = AppendedFile::open(
      path, {.not_whole = "the answers before are in it; make room, go on", .in_use = "end that one first"});
  if (!file) return tl::unexpected(file.error());
  RowFile out(std::move(*file));
  std::error_code error;
  Table table;
  if (std::filesystem::file_size(path, error) > 0 && !error) {
    const Result<std::string> text = read_input_file(path, kMaxTableBytes);
    if (!text) return tl::unexpected(text.error());
    Result<Table> parsed = parse(*text, path, identity);
    if (!parsed) return tl::unexpected(parsed.error());
    table = std::move(*parsed);
  }
  if (table.whole_bytes > 0 && table.read.columns != columns)
    return fail("has other columns than this protocol", path.string() + ":1",
                "use the protocol and the program that it was begun with");
  if (!table.read.complaint.empty())
    return fail("was changed by hand, or belongs to another protocol, participant or seed", table.read.complaint,
                "use the file as it was written, or another folder");
  if (Status ok = out.file_.keep(table.whole_bytes); !ok) return tl::unexpected(ok.error());
  out.last_check_ = table.last_check;
  out.rows_ = std::move(table.read.rows);
  if (table.whole_bytes == 0) {
    const std::string header = joined(columns) + std::string(kCheck);
    if (Status ok = out.file_.add_durably(header + "\n"); !ok) return tl::unexpected(ok.error());
    out.last_check_ = check_of(identity, header);
  }
  if (Status ok = out.begin_csv(columns); !ok) return tl::unexpected(ok.error());
  return out;
}

// Made anew at each start, from the rows that are there.
Status RowFile::begin_csv(const Fields& columns) {
  const std::filesystem::path path = std::filesystem::path(file_.path()).replace_extension(".csv");
  csv_ = ::open(path.c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
  std::string text = csv_line(columns);
  for (const Fields& row : rows_) text += csv_line(row);
  if (csv_ >= 0 && write_whole(csv_, text)) return {};
  return fail("can't be written: " + reason(), path.string(), "choose a folder that may be written, or make room");
}

Status RowFile::add(const Fields& fields) {
  const std::string text = joined(fields);
  const std::string check = check_of(last_check_, text);
  if (Status ok = file_.add_durably(text + check + "\n"); !ok) return ok;
  last_check_ = check;
  ++added_;
  static_cast<void>(write_whole(csv_, csv_line(fields)));
  return {};
}

}  // namespace tangent::experiment
