#include "workbench/session/file_origin.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

using namespace tangent;

namespace {

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t n = 0;
  for (std::size_t i = 0; i < 4; ++i) n = n << 8 | static_cast<unsigned char>(bytes[at + i]);
  return n;
}

/// Signature and header of a PNG file of one pixel, and its end.
std::string small_png() {
  std::string png("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
  png += std::string(13 + 4, '\1');
  return png + std::string("\0\0\0\0IEND\xAE\x42\x60\x82", 12);
}

/// What cairo writes of a PDF: one object, its place, and the trailer.
std::string small_pdf() {
  std::string pdf = "%PDF-1.5\n";
  const std::size_t object = pdf.size();
  pdf += "1 0 obj\n<< /Type /Catalog >>\nendobj\n";
  const std::size_t table = pdf.size();
  pdf += "xref\n0 2\n0000000000 65535 f \n000000000" + std::to_string(object) + " 00000 n \n";
  return pdf + "trailer\n<< /Size 2\n   /Root 1 0 R\n>>\nstartxref\n" + std::to_string(table) + "\n%%EOF\n";
}

}  // namespace

TEST_CASE("a PNG file says where it comes from in chunks after its header, whose sums are right") {
  const std::string png = small_png();
  const std::string out = png_with_origin(png, {.mesh = "torus \u00b5"});
  CHECK(out.substr(0, 33) == png.substr(0, 33));
  CHECK(out.substr(out.size() - 12) == png.substr(33));
  const std::string body = "iTXtMesh" + std::string(5, '\0') + "torus \u00b5";
  CHECK(number_at(out, 33) == body.size() - 4);
  CHECK(out.substr(37, body.size()) == body);
  CHECK(number_at(out, 37 + body.size()) == 0x1384223au);
  CHECK(png_with_origin("no picture", {.mesh = "torus"}) == "no picture");
}

TEST_CASE("an SVG file says it in an element of metadata, and no name breaks out of that") {
  const std::string out = svg_with_origin("<?xml?><svg width='3'><g/></svg>", {.mesh = "a<b>&c\nd", .command = "x"});
  CHECK(out.find("<svg width='3'>\n<metadata>\nMesh: a&lt;b&gt;&amp;c d\nCommand: x\n") != std::string::npos);
  CHECK(out.find("</metadata><g/></svg>") != std::string::npos);
}

TEST_CASE("a table says it in comment lines, one a fact, none that is not known") {
  const std::string text = csv_comment({.mesh = "torus", .unit = "mm\nrm"});
  CHECK(text.find("# Mesh: torus\n# Unit: mm rm\n# Software: Tangent Workbench ") == 0);
  CHECK(text.find("Preset") == std::string::npos);
}

TEST_CASE("a PDF file gets an information dictionary, found through a second table of references") {
  const std::string pdf = small_pdf();
  const Result<std::string> out = pdf_with_origin(pdf, {.mesh = "\u00b5 \U0001F600"});
  REQUIRE(out);
  CHECK(out->substr(0, pdf.size()) == pdf);
  CHECK(out->find("2 0 obj\n<< /Mesh <FEFF00B50020D83DDE00> /Creator <FEFF") == pdf.size());
  const std::size_t said = std::stoul(out->substr(out->rfind("startxref") + 10));
  REQUIRE(said < out->size());
  CHECK(out->substr(said, 9) == "xref\n2 1\n");
  CHECK(std::stoul(out->substr(said + 9, 10)) == pdf.size());
  CHECK(out->find("/Size 3 /Root 1 0 R /Info 2 0 R /Prev " + std::to_string(pdf.find("xref\n"))) != std::string::npos);
  CHECK_FALSE(pdf_with_origin("%PDF-1.5\nstartxref\n5\n%%EOF\n", {}));
  CHECK_FALSE(pdf_with_origin("", {}));
}

TEST_CASE("a word is typed as it is where a shell takes it so, else in quotes") {
  CHECK(shell_word("a/b-c.obj") == "a/b-c.obj");
  CHECK(shell_word("my mesh's.obj") == "'my mesh'\\''s.obj'");
  CHECK(shell_word("") == "''");
}
