#include "workbench/session/file_origin.h"

#include "core/base/text.h"

#include <array>
#include <charconv>
#include <cstdio>

namespace tangent {
namespace {

/// Without line ends and other control characters, which would end a comment.
std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

std::string big_endian(std::uint32_t n) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((n >> shift) & 255u);
  return bytes;
}

/// CRC-32 of PNG's chunks.
std::uint32_t crc(std::string_view bytes) {
  std::uint32_t c = 0xffffffffu;
  for (const char byte : bytes) {
    c ^= static_cast<unsigned char>(byte);
    for (int k = 0; k < 8; ++k) c = (c >> 1) ^ (c & 1u ? 0xedb88320u : 0u);
  }
  return c ^ 0xffffffffu;
}

/// International text: UTF-8, not compressed, of no language.
std::string text_chunk(const std::string& key, const std::string& text) {
  const std::string body = "iTXt" + key + std::string(5, '\0') + text;
  return big_endian(static_cast<std::uint32_t>(body.size() - 4)) + body + big_endian(crc(body));
}

std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

/// As a PDF's text string: bytes in hexadecimal, UTF-16 with its mark, which holds every character.
std::string pdf_text(const std::string& utf8) {
  std::string out = "<FEFF";
  const auto put = [&](std::uint32_t unit) {
    std::array<char, 8> digits{};
    std::snprintf(digits.data(), digits.size(), "%04X", unit);
    out += digits.data();
  };
  for (std::size_t i = 0; i < utf8.size();) {
    const auto first = static_cast<unsigned char>(utf8[i]);
    const std::size_t length = first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    std::uint32_t code = length == 1 ? first : first & (0x7fu >> length);
    for (std::size_t k = 1; k < length && i + k < utf8.size(); ++k)
      code = (code << 6) | (static_cast<unsigned char>(utf8[i + k]) & 0x3fu);
    i += length;
    if (code < 0x10000) {
      put(code);
    } else {
      put(0xd800 + ((code - 0x10000) >> 10));
      put(0xdc00 + ((code - 0x10000) & 0x3ff));
    }
  }
  return out + ">";
}

/// The whole number after the last `key` of a PDF; none: -1.
long number_after(std::string_view pdf, std::string_view key) {
  std::size_t at = pdf.rfind(key);
  if (at == std::string_view::npos) return -1;
  at = pdf.find_first_not_of(" \r\n", at + key.size());
  if (at == std::string_view::npos) return -1;
  long value = -1;
  const auto read = std::from_chars(pdf.data() + at, pdf.data() + pdf.size(), value);
  return read.ec == std::errc() ? value : -1;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> FileOrigin::facts() const {
  std::vector<std::pair<std::string, std::string>> all{
      {"Mesh", mesh}, {"Preset", preset}, {"Unit", unit}, {"Command", command}};
  all.emplace_back("Software", "Tangent Workbench " TANGENT_VERSION);
  std::vector<std::pair<std::string, std::string>> known;
  for (auto& [key, text] : all)
    if (!text.empty()) known.emplace_back(key, one_line(text));
  return known;
}

std::string mesh_fact(const std::string& name, std::size_t triangles, std::uint64_t content_hash) {
  std::array<char, 20> hash{};
  std::snprintf(hash.data(), hash.size(), "%016llx", static_cast<unsigned long long>(content_hash));
  return name + ", " + std::to_string(triangles) + " triangles, " + hash.data();
}

std::string unit_fact(double metres_per_unit) {
  std::string text = "1 unit of the mesh's file = ";
  append_double(text, metres_per_unit);
  return text + " m; SI in this one where nothing else is said";
}

std::string shell_word(const std::string& word) {
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+./:=,@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string csv_comment(const FileOrigin& origin) {
  std::string text;
  for (const auto& [key, fact] : origin.facts()) text += "# " + key + ": " + fact + "\n";
  return text;
}

std::string png_with_origin(std::string_view png, const FileOrigin& origin) {
  constexpr std::size_t kHeader = 8 + 25;  // signature and chunk IHDR
  if (png.size() < kHeader || png.substr(1, 3) != "PNG") return std::string(png);
  std::string out(png.substr(0, kHeader));
  for (const auto& [key, fact] : origin.facts()) out += text_chunk(key, fact);
  return out.append(png.substr(kHeader));
}

std::string svg_with_origin(std::string_view svg, const FileOrigin& origin) {
  const std::size_t element = svg.find("<svg"), end = element == svg.npos ? svg.npos : svg.find('>', element);
  if (end == svg.npos) return std::string(svg);
  std::string text = "\n<metadata>\n";
  for (const auto& [key, fact] : origin.facts()) text += key + ": " + xml_text(fact) + "\n";
  return std::string(svg.substr(0, end + 1)) + text + "</metadata>" + std::string(svg.substr(end + 1));
}

Result<std::string> pdf_with_origin(std::string_view pdf, const FileOrigin& origin) {
  const long table = number_after(pdf, "startxref"), size = number_after(pdf, "/Size"),
             root = number_after(pdf, "/Root");
  if (table <= 0 || size <= 0 || root <= 0 || pdf.substr(static_cast<std::size_t>(table), 4) != "xref")
    return fail("the PDF has no table of references", "gnuplot", "write it as SVG");
  std::string out(pdf);
  if (out.back() != '\n') out += '\n';
  const std::size_t object = out.size();
  const std::string number = std::to_string(size);
  out += number + " 0 obj\n<<";
  for (const auto& [key, fact] : origin.facts())
    out += " /" + (key == "Software" ? std::string("Creator") : key) + " " + pdf_text(fact);
  out += " >>\nendobj\n";
  const std::size_t references = out.size();
  std::array<char, 24> offset{};
  std::snprintf(offset.data(), offset.size(), "%010zu 00000 n \n", object);
  out += "xref\n" + number + " 1\n" + offset.data();
  out += "trailer\n<< /Size " + std::to_string(size + 1) + " /Root " + std::to_string(root) + " 0 R /Info " + number +
         " 0 R /Prev " + std::to_string(table) + " >>\nstartxref\n" + std::to_string(references) + "\n%%EOF\n";
  return out;
}

}  // namespace tangent
