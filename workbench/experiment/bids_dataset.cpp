#include "workbench/experiment/bids_dataset.h"

#include "core/io/atomic_file.h"
#include "workbench/experiment/utc_time.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace tangent::experiment {
namespace {

namespace fs = std::filesystem;
using TsvFields = std::vector<std::string>;

constexpr const char* kReadme =
    "Answers of an experiment with the haptic \"tangent plane on a PN triangle\" algorithm, written by `workbench "
    "experiment`.\n\nsub-*/beh holds a table of each participant (_beh.tsv, a row a trial), what its columns mean "
    "(_beh.json), and what else happened (_events.tsv). participants.tsv lists everybody; where its column `simulated` "
    "is not `no`, nobody felt anything. protocol-*.toml are the protocols as they were; `workbench analyse` makes the "
    "page.\n";

constexpr std::array<ColumnMeaning, 2> kParticipantColumns{{
    {"participant_id", "", "sub- and the name that was given when the experiment was begun"},
    {"simulated", "", "no, or what was simulated when the participant was begun, so that nobody felt anything"},
}};

constexpr std::array<ColumnMeaning, 1> kScanColumns{{
    {"simulated", "", "no, or what was simulated, so that nobody felt anything"},
}};

TsvFields tsv_fields(const std::string& line) {
  TsvFields out(1);
  for (const char c : line) {
    if (c == '\t')
      out.emplace_back();
    else
      out.back() += c;
  }
  return out;
}

std::string tsv_line(const TsvFields& fields) {
  std::string out;
  for (const std::string& field : fields) out += (out.empty() ? "" : "\t") + field;
  return out + "\n";
}

/// A file that this process alone writes while this exists.
class LockedFile {
 public:
  explicit LockedFile(const fs::path& path)
      : path_(path), file_(::open(path.c_str(), O_CREAT | O_RDWR | O_APPEND | O_CLOEXEC, 0666)) {
    while (file_ >= 0 && ::flock(file_, LOCK_EX) != 0 && errno == EINTR) {}
  }
  ~LockedFile() {
    if (file_ >= 0) ::close(file_);
  }
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

  std::string text() const {
    std::string out;
    std::array<char, 4096> some{};
    for (ssize_t count = 0;
         file_ >= 0 && (count = ::pread(file_, some.data(), some.size(), static_cast<off_t>(out.size()))) > 0;)
      out.append(some.data(), static_cast<std::size_t>(count));
    return out;
  }
  Status cut(std::size_t bytes) {
    return file_ >= 0 && ::ftruncate(file_, static_cast<off_t>(bytes)) == 0 ? Status{} : trouble();
  }
  /// All of it or none.
  Status add(const std::string& added, std::size_t before) {
    if (file_ >= 0 && ::write(file_, added.data(), added.size()) == static_cast<ssize_t>(added.size()) &&
        (::fdatasync(file_) == 0 || errno == EINVAL))
      return {};
    Status out = trouble();
    static_cast<void>(cut(before));
    return out;
  }

 private:
  Status trouble() const {
    return fail("can't be written: " + std::string(std::strerror(errno)), path_.string(),
                "choose a folder that may be written, or make room");
  }
  const fs::path& path_;
  int file_;
};

/// Adds a line to a list with a header, unless one begins with the same field. Columns of the file that `columns` does
/// not have get "n/a"; a line that was torn by a kill is cut off.
Status list_line(const fs::path& path, const TsvFields& columns, const TsvFields& values) {
  LockedFile file(path);
  std::string text = file.text();
  const std::size_t whole = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;
  if (whole < text.size())
    if (Status ok = file.cut(whole); !ok) return ok;
  text.resize(whole);
  TsvFields header = columns;
  std::string added;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    std::string line = text.substr(at, end - at);
    if (line.ends_with('\r')) line.pop_back();
    const TsvFields fields = tsv_fields(line);
    if (at == 0)
      header = fields;
    else if (fields.front() == values.front())
      return {};
    at = end + 1;
  }
  if (text.empty()) added = tsv_line(columns);
  TsvFields line;
  for (const std::string& name : header) {
    const auto found = std::find(columns.begin(), columns.end(), name);
    line.push_back(found == columns.end() ? "n/a" : values[static_cast<std::size_t>(found - columns.begin())]);
  }
  return file.add(added + tsv_line(line), text.size());
}

Status write_if_missing(const fs::path& path, const std::string& text) {
  std::error_code error;
  return fs::exists(path, error) ? Status{} : write_file_atomic(path, text);
}

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

}  // namespace

Status describe_dataset(const fs::path& folder) {
  const nlohmann::ordered_json description{
      {"Name", "Experiments of Tangent Workbench (participants.tsv says who was simulated)"},
      {"BIDSVersion", "1.9.0"},
      {"DatasetType", "raw"},
      {"GeneratedBy", {{{"Name", "Tangent Workbench"}, {"Version", TANGENT_VERSION}}}}};
  const std::pair<const char*, std::string> files[] = {
      {"dataset_description.json", description.dump(2) + "\n"},
      {"README", kReadme},
      {".bidsignore", "protocol-*.toml\n*_beh.csv\n*_events.csv\n*_recordings\n*_recordings/**\n"},
      {"participants.json", columns_json(kParticipantColumns)},
      {"scans.json", columns_json(kScanColumns)}};
  for (const auto& [name, text] : files)
    if (Status ok = write_if_missing(folder / name, text); !ok) return ok;
  return {};
}

Status list_participant(const fs::path& folder, const RunMark& mark) {
  return list_line(folder / "participants.tsv", {"participant_id", "simulated"},
                   {"sub-" + mark.participant, mark.simulated});
}

Status list_scan(const fs::path& rows, const RunMark& mark, std::int64_t began_utc_s) {
  const fs::path subject = rows.parent_path().parent_path();
  const std::string file = rows.parent_path().filename().string() + "/" + rows.filename().string();
  return list_line(subject / ("sub-" + mark.participant + "_scans.tsv"), {"filename", "acq_time", "simulated"},
                   {file, utc_text(began_utc_s), mark.simulated});
}

std::string twin_by_case(const fs::path& folder, const std::string& participant) {
  const std::string own = "sub-" + participant;
  std::error_code error;
  for (auto at = fs::directory_iterator(folder, error); !error && at != fs::directory_iterator(); at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (name != own && lower(name) == lower(own)) return name.substr(4);
  }
  return {};
}

}  // namespace tangent::experiment
