// A figure: its data as tables, and its drawing as SVG or PDF, by gnuplot. All figures are made by this: those of
// `workbench figures`, `bench --plot` and `report`, and the window's plots. Gnuplot, because it has what they need
// (logarithmic axes, error bars, several plots over one axis, keys, PDF) and one style serves them all.
#pragma once

#include "core/base/result.h"
#include "workbench/session/file_origin.h"

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

namespace tangent {

/// Numbers in named columns. A NaN is written as an empty field; an empty row separates curves.
struct FigureTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;

  void part() { rows.emplace_back(); }
  std::string csv() const;
};

struct FigureData {
  std::string suffix;  ///< of the file's name: "" or "-patches"
  FigureTable table;
};

struct Figure {
  std::string name;   ///< of the files, without extension
  std::string title;  ///< what it shows, for the list that is printed
  int width_px = 760, height_px = 480;
  std::vector<FigureData> data = {};
  /// gnuplot commands after the common ones; DIR is the folder. No name that a person typed belongs in here.
  std::string script = {};
};

/// The drawing as an SVG element to stand in a page: without ground, its identifiers begin with the figure's name,
/// which has to be a word. Colours are attributes, for the page's style to change (workbench/report/page_style.cpp).
Result<std::string> figure_svg(const Figure& figure);
/// Writes NAME.csv and further tables, then NAME.svg. Fails where gnuplot is missing or refuses, and where a file of
/// another kind has one of these names: nothing is written then.
Status write_figure(const Figure& figure, const std::filesystem::path& folder);
/// The drawing alone, with its origin, as what the file's name ends in: .svg or .pdf. Atomic; fails like the above, and
/// soon after `stop` is asked for: gnuplot is ended, and nothing is written.
Status write_drawing(const Figure& figure, const FileOrigin& origin, const std::filesystem::path& file,
                     const std::stop_token& stop = {});

}  // namespace tangent
