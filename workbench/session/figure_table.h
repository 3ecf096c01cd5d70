// A figure: its data as tables, and its drawing as SVG or PDF, by gnuplot. `workbench figures` and the window's plots
// are made by this.
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

/// Writes NAME.csv and further tables, then NAME.svg. Fails where gnuplot is missing or refuses.
Status write_figure(const Figure& figure, const std::filesystem::path& folder);
/// The drawing alone, with its origin, as what the file's name ends in: .svg or .pdf. Atomic; fails like the above, and
/// soon after `stop` is asked for: gnuplot is ended, and nothing is written.
Status write_drawing(const Figure& figure, const FileOrigin& origin, const std::filesystem::path& file,
                     const std::stop_token& stop = {});

}  // namespace tangent
