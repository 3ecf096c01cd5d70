#include "tests/support/approx.h"
#include "tests/workbench/recording/recording_fixture.h"
#include "workbench/recording/column_spool.h"
#include "workbench/recording/export.h"
#include "workbench/recording/exporter.h"

#if TANGENT_HAS_MATIO
#include <matio.h>
#endif

#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <functional>
#include <map>
#include <set>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("a table put in row by row comes out column by column") {
  const testing::TempFolder folder;
  for (const std::uint64_t rows : {0u, 1u, 4095u, 4096u, 4097u, 9000u}) {
    CAPTURE(rows);
    auto spool = ColumnSpool::create(folder.path(), 3, folder.file("a.mat"));
    REQUIRE(spool);
    for (std::uint64_t i = 0; i < rows; ++i) REQUIRE(spool->add({i, ~i, i * i}));
    std::vector<std::uint64_t> values;
    for (const std::size_t column : {2u, 0u, 1u}) {
      REQUIRE(spool->read(column, values));
      REQUIRE(values.size() == rows);
      bool same = true;
      for (std::uint64_t i = 0; i < rows; ++i) same = same && values[i] == std::array{i, ~i, i * i}[column];
      CHECK(same);
    }
  }
  CHECK(folder.entry_count() == 0);
  const auto nowhere = ColumnSpool::create(folder.file("none"), 3, "none/a.mat");
  REQUIRE_FALSE(nowhere);
  CHECK(says(message_of(nowhere.error()), "none/a.mat: cannot create a temporary file beside it"));
}

TEST_CASE("without libmatio a MATLAB file is an error that says what to install") {
  if (has_mat_files()) return;
  const testing::TempFolder folder;
  const std::string recorded = folder.file("a.sqlite");
  RecordedSession session(recorded);
  session.run(10);
  session.finish();
  const auto refused = export_ticks(recorded, folder.file("a.mat"));
  REQUIRE_FALSE(refused);
  CHECK(says(message_of(refused.error()), "libmatio-dev"));
  CHECK(folder.entry_count() == 1);
}

#if TANGENT_HAS_MATIO
namespace {

const std::string& second_to_export() {
  static const testing::TempFolder folder;
  static const std::string path = [] {
    std::string made = folder.file("a.sqlite");
    RecordedSession recorded(made);
    recorded.run(5000);
    recorded.finish();
    return made;
  }();
  return path;
}

struct CloseMat {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeMat {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using MatVariable = std::unique_ptr<matvar_t, FreeMat>;

/// All variables of a file, by name.
std::map<std::string, MatVariable> variables_of(const std::string& path) {
  const std::unique_ptr<mat_t, CloseMat> file(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
  REQUIRE(file);
  CHECK(Mat_GetVersion(file.get()) == MAT_FT_MAT5);
  std::map<std::string, MatVariable> found;
  while (MatVariable variable{Mat_VarReadNext(file.get())}) {
    const std::string name = variable->name;
    found[name] = std::move(variable);
  }
  return found;
}

/// One element of a column, of whichever type.
template <class T>
T element(const MatVariable& variable, std::size_t i) {
  T value;
  std::memcpy(&value, static_cast<const char*>(variable->data) + i * sizeof value, sizeof value);
  return value;
}
std::int64_t whole_element(const MatVariable& variable, std::size_t i) {
  switch (variable->class_type) {
    case MAT_C_UINT8:
      return element<std::uint8_t>(variable, i);
    case MAT_C_UINT32:
      return element<std::uint32_t>(variable, i);
    case MAT_C_INT32:
      return element<std::int32_t>(variable, i);
    case MAT_C_UINT64:
      return static_cast<std::int64_t>(element<std::uint64_t>(variable, i));
    default:
      return element<std::int64_t>(variable, i);
  }
}

/// about.PART.COLUMN
matvar_t* about_column(const MatVariable& about, const char* part, const std::string& column) {
  matvar_t* const of = Mat_VarGetStructFieldByName(about.get(), part, 0);
  REQUIRE(of != nullptr);
  return Mat_VarGetStructFieldByName(of, column.c_str(), 0);
}
std::string text_of(const matvar_t* text) {
  REQUIRE(text != nullptr);
  REQUIRE(text->class_type == MAT_C_CHAR);
  return {static_cast<const char*>(text->data), text->dims[0] * text->dims[1]};
}

}  // namespace

TEST_CASE("an exported MATLAB file has every value of every column, typed, with units and words") {
  REQUIRE(has_mat_files());
  const testing::TempFolder folder;
  const std::string mat = folder.file("a.mat");
  const auto count = export_ticks(second_to_export(), mat);
  REQUIRE_MESSAGE(count, (count ? "" : message_of(count.error())));
  CHECK(*count == 5000);
  CHECK(folder.entry_count() == 1);
  const auto variables = variables_of(mat);
  CHECK(variables.size() == 2 + real_columns().size() + whole_columns().size() + device_columns().size());
  const MatVariable& about = variables.at("about");
  std::vector<RecordedTick> ticks = all_ticks(second_to_export());
  const auto checked = [&](std::string_view name) -> const MatVariable& {
    CAPTURE(name);
    const MatVariable& variable = variables.at(std::string(name));
    CHECK(variable->dims[0] == ticks.size());
    CHECK(variable->dims[1] == 1);
    CHECK(text_of(about_column(about, "units", std::string(name))) == unit_of(name));
    return variable;
  };
  for (const RealColumn& column : real_columns()) {
    const MatVariable& variable = checked(column.name);
    CAPTURE(column.name);
    CHECK(variable->class_type == MAT_C_DOUBLE);
    bool same = true;
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      const auto value = element<double>(variable, i);
      const bool none = column.of_velocity && !ticks[i].has_velocity;
      same = same && (none ? std::isnan(value) : same_bits_of(value, column.at(ticks[i])));
    }
    CHECK(same);
  }
  for (const auto columns : {whole_columns(), device_columns()})
    for (const WholeColumn& column : columns) {
      const MatVariable& variable = checked(column.name);
      CAPTURE(column.name);
      bool same = true;
      for (std::size_t i = 0; i < ticks.size(); ++i) same = same && whole_element(variable, i) == column.get(ticks[i]);
      CHECK(same);
      matvar_t* const words = about_column(about, "words", std::string(column.name));
      REQUIRE((words != nullptr) == (column.word != nullptr));
      for (std::int64_t code = 0; words != nullptr && code <= column.most; ++code)
        CHECK(text_of(Mat_VarGetCell(words, static_cast<int>(code))) == column.word(code));
    }
  CHECK(variables.at("status")->class_type == MAT_C_UINT8);
  CHECK(variables.at("triangle")->class_type == MAT_C_INT64);
  CHECK(variables.at("iterations")->class_type == MAT_C_INT32);
  CHECK(whole_element(checked("tick"), 4999) == 4999);
  CHECK(text_of(about_column(about, "meanings", "force_y_n")) == "force on the finger, as computed");
  CHECK(text_of(Mat_VarGetStructFieldByName(about.get(), "recording", 0)) == "a.sqlite");
}

TEST_CASE("a selection of time and channels is exported to a MATLAB file") {
  const testing::TempFolder folder;
  const std::string mat = folder.file("a.mat");
  ExportOptions options;
  options.from_s = 0.2;
  options.to_s = 0.3;
  options.channels = {"force_z_n"};
  const auto count = export_ticks(second_to_export(), mat, options);
  REQUIRE(count);
  CHECK(*count == 101);
  const auto variables = variables_of(mat);
  CHECK(variables.size() == 4);  // about, tick, t_s, force_z_n
  CHECK(variables.at("force_z_n")->dims[0] == 101);
  CHECK(element<double>(variables.at("t_s"), 0) == approx(0.2));
}

TEST_CASE("a MATLAB file that is interrupted or finds no room leaves nothing, and the old one as it was") {
  const testing::TempFolder folder;
  const std::string mat = folder.write("a.mat", "the old one");
  ExportOptions options;
  std::size_t asked = 0;
  options.cancelled = [&asked] { return ++asked > 5002; };  // after all ticks, between columns
  const auto cancelled = export_ticks(second_to_export(), mat, options);
  REQUIRE_FALSE(cancelled);
  CHECK(says(message_of(cancelled.error()), "interrupted"));

  ExportOptions block;  // of 3 columns and 4,096 ticks: what waits for the file is 98,304 bytes, the file a bit more
  block.channels = {"force_z_n"};
  block.to_s = 4.095;
  REQUIRE(*export_ticks(second_to_export(), folder.file("whole.mat"), block) == 4096);
  const std::uintmax_t size = std::filesystem::file_size(folder.file("whole.mat"));
  std::filesystem::remove(folder.file("whole.mat"));
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &limit) == 0);
  for (const rlim_t room : {size - 1, std::uintmax_t{98'304}}) {
    const rlimit less{room, limit.rlim_max};
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &less) == 0);
    const auto full = export_ticks(second_to_export(), mat, block);
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
    REQUIRE_FALSE(full);
    CHECK(says(message_of(full.error()), "whole"));
  }
  std::signal(SIGXFSZ, before);
  CHECK(testing::read_text(mat) == "the old one");
  CHECK(folder.entry_count() == 1);
}
#endif
