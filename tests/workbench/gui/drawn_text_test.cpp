#include "tests/workbench/gui/drawn_text.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>

namespace {

tangent::test::TextRecorder* g_recorder = nullptr;

void note_text(const ImDrawList& list, const ImFont* font, float size, ImVec2 at, ImU32 ink, std::string text,
               float wrap, const ImVec4* fine, int first_vertex) {
  if (g_recorder == nullptr || text.empty() || (ink & IM_COL32_A_MASK) == 0) return;
  tangent::test::DrawnText drawn;
  const ImVec2 extent = font->CalcTextSizeA(size, 1e9f, wrap, text.c_str());
  drawn.min = at;
  drawn.max = {at.x + extent.x, at.y + extent.y};
  ImVec4 clip = list._CmdHeader.ClipRect;
  if (fine != nullptr)
    clip = {std::max(clip.x, fine->x), std::max(clip.y, fine->y), std::min(clip.z, fine->z), std::min(clip.w, fine->w)};
  drawn.clip_min = {clip.x, clip.y};
  drawn.clip_max = {clip.z, clip.w};
  drawn.ink = ink;
  drawn.list = &list;
  drawn.first_vertex = first_vertex;
  drawn.end_vertex = list.VtxBuffer.Size;
  drawn.line = size;
  drawn.text = std::move(text);
  g_recorder->add(std::move(drawn));
}

std::string of_range(const char* begin, const char* end) {
  return begin == nullptr ? std::string() : end == nullptr ? std::string(begin) : std::string(begin, end);
}

}  // namespace

// What the linker calls in place of ImDrawList's two AddText, and the names that it gives to these.
extern "C" {
void __real__ZN10ImDrawList7AddTextERK6ImVec2jPKcS4_(ImDrawList*, const ImVec2&, ImU32, const char*, const char*);
void __wrap__ZN10ImDrawList7AddTextERK6ImVec2jPKcS4_(ImDrawList*, const ImVec2&, ImU32, const char*, const char*);
void __real__ZN10ImDrawList7AddTextEPK6ImFontfRK6ImVec2jPKcS7_fPK6ImVec4(ImDrawList*, const ImFont*, float,
                                                                         const ImVec2&, ImU32, const char*, const char*,
                                                                         float, const ImVec4*);
void __wrap__ZN10ImDrawList7AddTextEPK6ImFontfRK6ImVec2jPKcS7_fPK6ImVec4(ImDrawList*, const ImFont*, float,
                                                                         const ImVec2&, ImU32, const char*, const char*,
                                                                         float, const ImVec4*);

void __wrap__ZN10ImDrawList7AddTextERK6ImVec2jPKcS4_(ImDrawList* list, const ImVec2& at, ImU32 ink, const char* begin,
                                                     const char* end) {
  const int first = list->VtxBuffer.Size;
  __real__ZN10ImDrawList7AddTextERK6ImVec2jPKcS4_(list, at, ink, begin, end);
  const ImDrawListSharedData& shared = *list->_Data;
  note_text(*list, shared.Font, shared.FontSize, at, ink, of_range(begin, end), 0.0f, nullptr, first);
}

void __wrap__ZN10ImDrawList7AddTextEPK6ImFontfRK6ImVec2jPKcS7_fPK6ImVec4(ImDrawList* list, const ImFont* font,
                                                                         float size, const ImVec2& at, ImU32 ink,
                                                                         const char* begin, const char* end, float wrap,
                                                                         const ImVec4* fine) {
  const int first = list->VtxBuffer.Size;
  __real__ZN10ImDrawList7AddTextEPK6ImFontfRK6ImVec2jPKcS7_fPK6ImVec4(list, font, size, at, ink, begin, end, wrap,
                                                                      fine);
  const ImDrawListSharedData& shared = *list->_Data;
  note_text(*list, font != nullptr ? font : shared.Font, size != 0.0f ? size : shared.FontSize, at, ink,
            of_range(begin, end), wrap, fine, first);
}
}

namespace tangent::test {

TextRecorder::TextRecorder() { g_recorder = this; }
TextRecorder::~TextRecorder() { g_recorder = nullptr; }

std::vector<DrawnText> TextRecorder::texts() const {
  std::vector<DrawnText> out;
  const ImDrawData& data = *ImGui::GetDrawData();
  const auto shown = [&](const ImDrawList* list) {
    return std::find(data.CmdLists, data.CmdLists + data.CmdListsCount, list) != data.CmdLists + data.CmdListsCount;
  };
  for (const DrawnText& text : texts_) {
    if (!text.in_view() || !shown(text.list)) continue;
    const bool again = !out.empty() && out.back().text == text.text && out.back().list == text.list &&
                       std::abs(out.back().min.x - text.min.x) < 0.4f * text.line &&
                       std::abs(out.back().min.y - text.min.y) < 0.4f * text.line;
    if (!again) {
      out.push_back(text);
      continue;
    }
    const int first = out.back().first_vertex;
    out.back() = text;
    out.back().first_vertex = std::min(first, text.first_vertex);
  }
  return out;
}

bool collide(const DrawnText& a, const DrawnText& b) {
  const auto seen = [](const DrawnText& t) {
    return ImVec4(std::max(t.min.x, t.clip_min.x), std::max(t.min.y, t.clip_min.y), std::min(t.max.x, t.clip_max.x),
                  std::min(t.max.y, t.clip_max.y));
  };
  const ImVec4 p = seen(a), q = seen(b);
  // A line is higher than its letters, by a quarter.
  return std::min(p.z, q.z) - std::max(p.x, q.x) > 1.0f &&
         std::min(p.w, q.w) - std::max(p.y, q.y) > 0.3f * std::min(a.line, b.line);
}

namespace {

/// A filled triangle of the frame, and its place in the order of drawing.
struct Filled {
  std::array<ImDrawVert, 3> corner;
  ImVec4 clip;
  std::size_t order;
};

double cross(ImVec2 a, ImVec2 b, ImVec2 p) {
  return static_cast<double>((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x));
}

/// Colour at the place, r, g, b, a; alpha 0 outside.
std::array<double, 4> colour_at(const Filled& t, ImVec2 p) {
  if (p.x < t.clip.x || p.y < t.clip.y || p.x > t.clip.z || p.y > t.clip.w) return {};
  const double whole = cross(t.corner[0].pos, t.corner[1].pos, t.corner[2].pos);
  const std::array<double, 3> w{cross(t.corner[1].pos, t.corner[2].pos, p) / whole,
                                cross(t.corner[2].pos, t.corner[0].pos, p) / whole,
                                cross(t.corner[0].pos, t.corner[1].pos, p) / whole};
  if (*std::min_element(w.begin(), w.end()) < 0.0) return {};
  std::array<double, 4> out{};
  for (std::size_t i = 0; i < 3; ++i) {
    const ImVec4 c = ImGui::ColorConvertU32ToFloat4(t.corner[i].col);
    const std::array<float, 4> v{c.x, c.y, c.z, c.w};
    for (std::size_t k = 0; k < 4; ++k) out[k] += w[i] * static_cast<double>(v[k]);
  }
  return out;
}

double luminance(const std::array<double, 3>& c) {
  const auto one = [](double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); };
  return 0.2126 * one(c[0]) + 0.7152 * one(c[1]) + 0.0722 * one(c[2]);
}

/// Where the frame begins to draw each of the texts, and what it fills, in order.
struct Drawing {
  std::vector<Filled> filled;
  std::map<const ImDrawList*, std::map<int, std::size_t>> first_order;  ///< of a vertex
};

Drawing read_drawing() {
  Drawing out;
  std::size_t order = 0;
  const ImDrawData& data = *ImGui::GetDrawData();
  const ImVec2 white = ImGui::GetIO().Fonts->TexUvWhitePixel;
  const auto solid = [&](const ImDrawVert& v) { return v.uv.x == white.x && v.uv.y == white.y; };
  for (int l = 0; l < data.CmdListsCount; ++l) {
    const ImDrawList& list = *data.CmdLists[l];
    auto& starts = out.first_order[&list];
    for (const ImDrawCmd& command : list.CmdBuffer) {
      for (unsigned i = 0; i + 2 < command.ElemCount; i += 3) {
        ++order;
        std::array<int, 3> at{};
        std::array<ImDrawVert, 3> corner{};
        for (unsigned k = 0; k < 3; ++k) {
          at[k] = static_cast<int>(list.IdxBuffer[static_cast<int>(command.IdxOffset + i + k)] + command.VtxOffset);
          corner[k] = list.VtxBuffer[at[k]];
        }
        if (!solid(corner[0])) {
          starts.emplace(*std::min_element(at.begin(), at.end()), order);
          continue;
        }
        if (std::abs(cross(corner[0].pos, corner[1].pos, corner[2].pos)) < 60.0) continue;  // no ground, a line
        out.filled.push_back({corner, command.ClipRect, order});
      }
    }
  }
  return out;
}

double contrast_at(const Drawing& drawing, const DrawnText& text, std::size_t order, const ImVec4& cleared, ImVec2 at) {
  std::array<double, 3> ground{static_cast<double>(cleared.x), static_cast<double>(cleared.y),
                               static_cast<double>(cleared.z)};
  const auto over = [&](const std::array<double, 4>& c) {
    for (std::size_t k = 0; k < 3; ++k) ground[k] += c[3] * (c[k] - ground[k]);
  };
  for (const Filled& filled : drawing.filled) {
    if (filled.order >= order) break;
    over(colour_at(filled, at));
  }
  const double below = luminance(ground);
  const ImVec4 ink = ImGui::ColorConvertU32ToFloat4(text.ink);
  over(
      {static_cast<double>(ink.x), static_cast<double>(ink.y), static_cast<double>(ink.z), static_cast<double>(ink.w)});
  const double letters = luminance(ground);
  return (std::max(below, letters) + 0.05) / (std::min(below, letters) + 0.05);
}

}  // namespace

std::vector<double> contrasts(const std::vector<DrawnText>& texts, const ImVec4& cleared) {
  const Drawing drawing = read_drawing();
  std::vector<double> out;
  for (const DrawnText& text : texts) {
    double worst = 21.0;
    const auto list = drawing.first_order.find(text.list);
    if (list != drawing.first_order.end()) {
      const auto found = list->second.lower_bound(text.first_vertex);
      const float left = std::max(text.min.x, text.clip_min.x), right = std::min(text.max.x, text.clip_max.x);
      if (found != list->second.end() && found->first < text.end_vertex)
        for (const float share : {0.1f, 0.5f, 0.9f})
          worst = std::min(worst, contrast_at(drawing, text, found->second, cleared,
                                              {left + share * (right - left), 0.5f * (text.min.y + text.max.y)}));
    }
    out.push_back(worst);
  }
  return out;
}

}  // namespace tangent::test

using tangent::test::collide;
using tangent::test::contrasts;
using tangent::test::DrawnText;
using tangent::test::TextRecorder;

TEST_CASE("texts that lie over one another, are cut or too pale are found, and others are not") {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.DisplaySize = {400.0f, 300.0f};
  io.Fonts->Build();
  TextRecorder recorder;
  ImGui::NewFrame();
  ImDrawList& draw = *ImGui::GetForegroundDrawList();
  draw.AddRectFilled({0, 0}, {400, 300}, IM_COL32(255, 255, 255, 255));
  draw.AddRectFilled({0, 200}, {400, 300}, IM_COL32(0, 0, 0, 128));
  const ImU32 black = IM_COL32(0, 0, 0, 255);
  draw.AddText({10, 10}, black, "one");
  draw.AddText({20, 13}, black, "over it");
  draw.AddText({10, 60}, black, "beside");
  draw.AddText({100, 60}, IM_COL32(150, 150, 150, 255), "pale");
  draw.AddText({10, 240}, IM_COL32(90, 90, 90, 255), "on grey");
  draw.PushClipRect({0, 100}, {60, 120}, true);
  draw.AddText({10, 100}, black, "longer than its room");
  draw.PopClipRect();
  for (const float by : {-1.0f, 1.0f}) draw.AddText({200 + by, 10}, IM_COL32(255, 255, 255, 128), "haloed");
  draw.AddText({200, 10}, black, "haloed");
  ImGui::Render();
  const std::vector<DrawnText> all = recorder.texts();
  REQUIRE(all.size() == 7);
  CHECK(collide(all[0], all[1]));
  CHECK_FALSE(collide(all[2], all[3]));
  CHECK(all[5].cut_right() > 50.0f);
  CHECK(all[2].cut_right() < 0.0f);
  CHECK(all[6].ink == black);
  const std::vector<double> contrast = contrasts(all, {0.0f, 0.0f, 0.0f, 1.0f});
  CHECK(contrast[0] == approx(21.0).epsilon(0.01));
  CHECK(contrast[3] < 4.5);
  CHECK(contrast[4] < 4.5);
  CHECK(contrast[6] > 20.0);
  ImGui::DestroyContext();
}
