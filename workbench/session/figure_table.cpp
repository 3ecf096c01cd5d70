#include "workbench/session/figure_table.h"

#include "core/base/text.h"
#include "core/io/atomic_file.h"
#include "core/io/replaceable_file.h"
#include "workbench/session/own_folder.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>

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

/// A file without a name, which a child process reads as its standard input.
Result<int> unnamed_file(const std::string& text) {
  const int file = ::memfd_create("figure", MFD_CLOEXEC);
  if (file < 0) return fail("no room for its script", "gnuplot", "free some memory");
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t now = ::write(file, text.data() + done, text.size() - done);
    if (now <= 0) return fail("no room for its script", "gnuplot", "free some memory");
    done += static_cast<std::size_t>(now);
  }
  ::lseek(file, 0, SEEK_SET);
  return file;
}

constexpr int kLookEvery_ms = 50;  // whether to stop

/// Up to its end, or until it is stopped.
std::string read_all(int file, const std::stop_token& stop) {
  std::string text;
  char part[4096];
  while (!stop.stop_requested()) {
    pollfd waited{file, POLLIN, 0};
    if (::poll(&waited, 1, kLookEvery_ms) == 0) continue;
    const ssize_t got = ::read(file, part, sizeof part);
    if (got == 0 || (got < 0 && errno != EINTR)) break;
    if (got > 0) text.append(part, static_cast<std::size_t>(got));
  }
  return text;
}

/// What gnuplot draws, with `folder` as its working folder. No shell is asked, and no name that a person typed reaches
/// its script: a newline in one would begin a command, and gnuplot has `system`.
Result<std::string> run_gnuplot(const std::string& script, const std::filesystem::path& folder, const std::string& name,
                                const std::stop_token& stop) {
  const Result<int> input = unnamed_file(script);
  if (!input) return tl::unexpected(input.error());
  std::array<int, 2> output{};
  if (::pipe2(output.data(), O_CLOEXEC) != 0) return fail("gnuplot can't be started", name);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, *input, STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, output[1], STDOUT_FILENO);
  ::posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  std::string program = "gnuplot";
  std::array<char*, 2> arguments{program.data(), nullptr};
  pid_t child = 0;
  const int failed = ::posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(*input);
  ::close(output[1]);
  const std::string drawn = failed == 0 ? read_all(output[0], stop) : std::string();
  ::close(output[0]);
  if (failed == ENOENT) return fail("gnuplot is not installed", "figures", "install Debian's package gnuplot-nox");
  if (failed != 0) return fail(std::string("gnuplot can't be started: ") + std::strerror(failed), name);
  if (stop.stop_requested()) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {}
  if (stop.stop_requested()) return fail("cancelled, nothing is written", name);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    return fail("gnuplot could not draw it", name, "see its message above");
  return drawn;
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

namespace {

Status write_data(const Figure& figure, const std::filesystem::path& folder) {
  for (const FigureData& data : figure.data) {
    const auto path = folder / (figure.name + data.suffix + ".csv");
    if (Status status = write_file_atomic(path, data.table.csv()); !status) return status;
  }
  return {};
}

enum class Drawn { svg, svg_in_page, pdf };

std::string terminal(const Figure& figure, Drawn as) {
  if (as != Drawn::pdf)
    return "set terminal svg size " + std::to_string(figure.width_px) + "," + std::to_string(figure.height_px) +
           " dynamic enhanced font 'Inter, Helvetica, Arial,13'" +
           (as == Drawn::svg ? " background rgb 'white'\n" : "\n");
  constexpr double kPixelsPerInch = 96.0;
  return "set terminal pdfcairo size " + std::to_string(figure.width_px / kPixelsPerInch) + "in," +
         std::to_string(figure.height_px / kPixelsPerInch) + "in enhanced font 'Inter,10' linewidth 0.75\n";
}

Result<std::string> draw(const Figure& figure, const std::filesystem::path& folder, const std::string& name, Drawn as,
                         const std::stop_token& stop = {}) {
  return run_gnuplot(terminal(figure, as) + kCommon + "DIR = '.'\n" + figure.script, folder, name, stop);
}

void replace_all(std::string& text, std::string_view from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size()) text.replace(at, from.size(), to);
}

void erase_elements(std::string& text, const std::string& name) {
  const std::string open = "<" + name + ">", close = "</" + name + ">";
  for (std::size_t at = 0; (at = text.find(open, at)) != text.npos;)
    text.erase(at, std::min(text.find(close, at) - at, text.size()) + close.size());
}

/// Gnuplot's file as an element: without its declaration and its names of curves, which a browser would show, and with
/// identifiers of its own, since a page may hold many.
std::string svg_element(std::string svg, const std::string& name) {
  svg.erase(0, std::min(svg.find("<svg"), svg.size()));
  for (const char* spoken : {"title", "desc"}) erase_elements(svg, spoken);
  for (const std::string quote : {"'", "\""}) replace_all(svg, "id=" + quote, "id=" + quote + name + "-");
  replace_all(svg, "xlink:href='#", "href='#" + name + "-");
  replace_all(svg, "xlink:href=\"#", "href=\"#" + name + "-");
  replace_all(svg, "url(#", "url(#" + name + "-");
  return svg;
}

}  // namespace

Result<std::string> figure_svg(const Figure& figure) {
  const Result<OwnFolder> folder = OwnFolder::make();
  if (!folder) return tl::unexpected(folder.error());
  if (Status status = write_data(figure, folder->path()); !status) return tl::unexpected(status.error());
  const Result<std::string> drawn = draw(figure, folder->path(), figure.name, Drawn::svg_in_page);
  if (!drawn) return drawn;
  return svg_element(*drawn, figure.name);
}

namespace {

/// No file of another kind is written over: a table with other columns, a drawing that gnuplot did not make.
Status check_own_files(const Figure& figure, const std::filesystem::path& folder) {
  for (const FigureData& data : figure.data) {
    const std::string header = FigureTable{data.table.columns, {}}.csv();
    const auto is_ours = [&](std::string_view beginning) { return beginning.starts_with(header); };
    if (Status ok = check_replaceable(folder / (figure.name + data.suffix + ".csv"), "this figure's table", is_ours);
        !ok)
      return ok;
  }
  return check_replaceable(
      folder / (figure.name + ".svg"), "a drawing of this program",
      [](std::string_view beginning) { return beginning.find("Produced by GNUPLOT") != std::string_view::npos; });
}

}  // namespace

Status write_figure(const Figure& figure, const std::filesystem::path& folder) {
  if (Status ok = check_own_files(figure, folder); !ok) return ok;
  if (Status status = write_data(figure, folder); !status) return status;
  const std::filesystem::path target = folder / (figure.name + ".svg");
  const Result<std::string> drawn = draw(figure, folder, target.string(), Drawn::svg);
  if (!drawn) return tl::unexpected(drawn.error());
  return write_file_atomic(target, *drawn);
}

Status write_drawing(const Figure& figure, const FileOrigin& origin, const std::filesystem::path& file,
                     const std::stop_token& stop) {
  const bool pdf = file.extension() == ".pdf";
  if (!pdf && file.extension() != ".svg") return fail("is neither .svg nor .pdf", file.string(), "name one of them");
  const Result<OwnFolder> folder = OwnFolder::make();
  if (!folder) return tl::unexpected(folder.error());
  if (Status status = write_data(figure, folder->path()); !status) return status;
  const Result<std::string> drawn = draw(figure, folder->path(), file.string(), pdf ? Drawn::pdf : Drawn::svg, stop);
  if (!drawn) return tl::unexpected(drawn.error());
  if (!pdf) return write_file_atomic(file, svg_with_origin(*drawn, origin));
  const Result<std::string> whole = pdf_with_origin(*drawn, origin);
  if (!whole) return tl::unexpected(whole.error());
  return write_file_atomic(file, *whole);
}

}  // namespace tangent
