// Pieces of a page. What a person or a file named goes through `escaped`, and nothing else puts text into the page.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

/// Text for an element or a quoted attribute: & < > " ' as entities, and control characters, which HTML forbids, as
/// U+FFFD. Bytes that are not UTF-8 become U+FFFD, too.
std::string escaped(std::string_view text);

/// "<name>content</name>"; `attributes`: "class=\"command\"", already escaped. `content` is HTML.
std::string element(std::string_view name, std::string_view content, std::string_view attributes = {});

/// What stands in a cell of a table.
struct Cell {
  std::string html;
  bool number = false;  ///< set to the right, in figures of one width
};
Cell text_cell(std::string_view text);
/// A number as people read it, with its exact value and its name in the page beside: `<td data-name="..."
/// data-value="...">`, for programs.
Cell number_cell(std::string_view name, double value, std::string_view shown);
Cell count_cell(std::string_view name, std::uint64_t count);

struct Table {
  std::string caption;
  std::vector<std::string> header;  ///< text
  std::vector<std::vector<Cell>> rows;
  std::string command;  ///< that gives these numbers; empty: none
  bool wide = false;    ///< set smaller
};
std::string table_html(const Table& table);

/// The command that a figure or table comes from, as one line to copy.
std::string command_html(std::string_view command);
std::string paragraph(std::string_view text);

}  // namespace tangent
