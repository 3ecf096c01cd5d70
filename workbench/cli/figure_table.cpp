#include "workbench/cli/figure_table.h"

#include "core/base/text.h"
#include "core/io/atomic_file.h"
#include "workbench/cli/text_format.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace tangent {
namespace {

/// Journal style: thin black axes, faint grid, the colour-blind safe palette of Okabe & Ito.
constexpr const char* kCommon = R"(set datafile separator ','
set datafile columnheaders
set encoding utf8
set border 3 lw 1 lc rgb '#444444'
set tics nomirror out scale 0.6 textcolor rgb '#222222'
set grid lw 0.6 lc rgb '#e3e3e3'
set key left top reverse Left samplen 2.4 spacing 1.25 textcolor rgb '#222222'
set style line 1 lc rgb '#0072B2' lw 2
set style line 2 lc rgb '#D55E00' lw 2
set style line 3 lc rgb '#009E73' lw 2
set style line 4 lc rgb '#CC79A7' lw 2
set style line 5 lc rgb '#E69F00' lw 2
set style line 6 lc rgb '#56B4E9' lw 2
set style line 8 lc rgb '#222222' lw 1.2
set style line 9 lc rgb '#999999' lw 1 dt (6,4)
)";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

/// A gnuplot string in single quotes.
std::string quoted(const std::string& text) { return "'" + replaced(text, "'", "''") + "'"; }

Status run_gnuplot(const std::string& script, const std::string& name) {
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0)
    return fail("gnuplot is not installed", "figures", "install Debian's package gnuplot-nox");
  std::FILE* pipe = ::popen("gnuplot 1>&2", "w");
  if (pipe == nullptr) return fail("gnuplot can't be started", name);
  const bool written = std::fwrite(script.data(), 1, script.size(), pipe) == script.size();
  if (const int code = ::pclose(pipe); !written || code != 0)
    return fail("gnuplot could not draw it", name, "see its message above");
  return {};
}

}  // namespace

std::string FigureTable::csv() const {
  std::string text;
  for (std::size_t i = 0; i < columns.size(); ++i) text += (i ? "," : "") + columns[i];
  text += '\n';
  for (const std::vector<double>& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i) text += ',';
      if (std::isfinite(row[i])) append_double(text, row[i]);
    }
    text += '\n';
  }
  return text;
}

Status write_figure(const Figure& figure, const std::filesystem::path& folder) {
  for (const FigureData& data : figure.data) {
    const auto path = folder / (figure.name + data.suffix + ".csv");
    if (Status status = write_file_atomic(path, data.table.csv()); !status) return status;
  }
  // Drawn to a temporary file, then renamed.
  const std::filesystem::path target = folder / (figure.name + ".svg"), part = folder / (figure.name + ".svg.part");
  std::string script =
      format("set terminal svg size %d,%d dynamic enhanced font 'Inter, Helvetica, Arial,13' background rgb 'white'\n",
             figure.width_px, figure.height_px);
  script += "set output " + quoted(part.string()) + "\n" + kCommon + "DIR = " + quoted(folder.string()) + "\n" +
            figure.script + "unset output\n";
  if (Status status = run_gnuplot(script, target.string()); !status) return status;
  std::error_code error;
  std::filesystem::rename(part, target, error);
  if (error) return fail("can't be written: " + error.message(), target.string());
  return {};
}

}  // namespace tangent
