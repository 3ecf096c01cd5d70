#include "workbench/report/html.h"

#include "core/base/text.h"
#include "workbench/report/numbers.h"

#include <cmath>

namespace tangent {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

/// Bytes of the character that starts there; 0: none does (RFC 3629: no overlong forms, surrogates, or above 10FFFF).
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xc2 && first < 0xe0 ? 2 : first >= 0xe0 && first < 0xf0 ? 3 : 4;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0u) != 0x80u) return 0;
  const bool overlong = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xf0 && byte(1) < 0x90);
  const bool outside = (first == 0xed && byte(1) >= 0xa0) || (first == 0xf4 && byte(1) >= 0x90);
  return overlong || outside ? 0 : length;
}

std::string_view entity_of(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return {};
  }
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const auto first = static_cast<unsigned char>(text.front());
    const bool control = (first < 0x20 && first != '\n' && first != '\t') || first == 0x7f;
    if (length == 0 || control)
      out += kReplacement;
    else if (const std::string_view entity = entity_of(text.front()); !entity.empty())
      out += entity;
    else
      out += text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return out;
}

std::string element(std::string_view name, std::string_view content, std::string_view attributes) {
  std::string out = "<" + std::string(name);
  if (!attributes.empty()) out += " " + std::string(attributes);
  return out + ">" + std::string(content) + "</" + std::string(name) + ">\n";
}

Cell text_cell(std::string_view text) { return {"<td>" + escaped(text) + "</td>"}; }

Cell number_cell(std::string_view name, double value, std::string_view shown) {
  if (!std::isfinite(value)) return {"<td class=\"number\">" + escaped(shown) + "</td>", true};
  std::string exact;
  append_double(exact, value);
  return {"<td class=\"number\" data-name=\"" + escaped(name) + "\" data-value=\"" + exact + "\">" + escaped(shown) +
              "</td>",
          true};
}

Cell count_cell(std::string_view name, std::uint64_t count) {
  return number_cell(name, static_cast<double>(count), count_text(count));
}

std::string table_html(const Table& table) {
  std::string rows;
  for (const auto& row : table.rows) {
    rows += "<tr>";
    for (const Cell& cell : row) rows += cell.html;
    rows += "</tr>\n";
  }
  std::string head;
  for (std::size_t i = 0; i < table.header.size(); ++i) {
    const bool number = !table.rows.empty() && i < table.rows.front().size() && table.rows.front()[i].number;
    head += std::string("<th scope=\"col\"") + (number ? " class=\"number\"" : "") + ">" + escaped(table.header[i]) +
            "</th>";
  }
  std::string html = table.caption.empty() ? "" : element("caption", escaped(table.caption));
  if (!head.empty()) html += element("thead", "<tr>" + head + "</tr>");
  html += element("tbody", "\n" + rows);
  return element("div", element("table", html, table.wide ? "class=\"wide\"" : "") + command_html(table.command),
                 "class=\"table\"");
}

std::string command_html(std::string_view command) {
  return command.empty() ? "" : element("code", escaped(command), "class=\"command\"");
}

std::string paragraph(std::string_view text) { return element("p", escaped(text)); }

}  // namespace tangent
