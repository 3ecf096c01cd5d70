#include "workbench/gui/experiment/participant_screen.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace tangent {
namespace {

ImU32 ink(std::uint32_t rrggbb) { return packed(rgb_hex(rrggbb)); }

float width_of(const ImFont* font, const std::string& text) {
  return font->CalcTextSizeA(font->FontSize, 1e9f, 0.0f, text.c_str()).x;
}

/// Lines no wider than `room`; a sentence begins a new one.
std::vector<std::string> lines_of(const ImFont* font, const std::string& text, float room) {
  std::vector<std::string> lines;
  const char *at = text.c_str(), *const end = at + text.size();
  while (at < end) {
    const char* stop = std::find_if(at, end, [&](const char& c) {
      return std::strchr(".?!", c) != nullptr && (&c + 1 == end || c != '.' || *(&c + 1) == ' ');
    });
    if (stop < end) ++stop;
    const char* const wrapped = font->CalcWordWrapPositionA(1.0f, at, stop, room);
    const char* const cut = wrapped == at ? at + 1 : wrapped;
    lines.emplace_back(at, cut);
    at = std::find_if(cut, end, [](char c) { return c != ' '; });
  }
  return lines;
}

struct Page {
  ImDrawList& draw;
  ImVec2 size;

  void line(const ImFont* font, float y, ImU32 colour, const std::string& text) const {
    draw.AddText(font, font->FontSize, {0.5f * (size.x - width_of(font, text)), y}, colour, text.c_str());
  }
  /// Lines in the middle of the width, from `y` on. Returns where they end.
  float lines(const ImFont* font, float y, ImU32 colour, const std::string& text) const {
    for (const std::string& one : lines_of(font, text, 0.88f * size.x)) {
      line(font, y, colour, one);
      y += 1.25f * font->FontSize;
    }
    return y;
  }
};

/// A key as a box with its name, what it means below. Returns the width that it takes.
float key_width(const LargeFonts& fonts, const ScreenKey& key) {
  const float box = std::max(1.7f * fonts.key->FontSize, width_of(fonts.key, key.key) + 0.9f * fonts.key->FontSize);
  return std::max(box, width_of(fonts.caption, key.means) + 0.3f * fonts.caption->FontSize);
}

void draw_key(const Page& page, const LargeFonts& fonts, const ParticipantColours& c, const ScreenKey& key, float x,
              float y) {
  const float whole = key_width(fonts, key), size = fonts.key->FontSize, name = width_of(fonts.key, key.key);
  const float box = std::max(1.7f * size, name + 0.9f * size), left = x + 0.5f * (whole - box);
  const ImVec2 max{left + box, y + 1.7f * size};
  if (key.pressed) page.draw.AddRectFilled({left, y}, max, c.pressed, 0.2f * size);
  page.draw.AddRect({left, y}, max, key.pressed ? c.pressed : c.key, 0.2f * size, 0, std::max(2.0f, 0.06f * size));
  page.draw.AddText(fonts.key, size, {left + 0.5f * (box - name), y + 0.32f * size},
                    key.pressed ? c.on_pressed : c.text, key.key.c_str());
  page.draw.AddText(fonts.caption, fonts.caption->FontSize,
                    {x + 0.5f * (whole - width_of(fonts.caption, key.means)), y + 1.9f * size}, c.text,
                    key.means.c_str());
}

void draw_keys(const Page& page, const LargeFonts& fonts, const ParticipantColours& c,
               const ParticipantScreen& screen) {
  const float gap = 0.6f * fonts.caption->FontSize;
  float whole = -gap;
  for (const ScreenKey& key : screen.keys) whole += gap + key_width(fonts, key);
  float x = 0.5f * (page.size.x - whole);
  const float y = page.size.y - 2.2f * fonts.key->FontSize - 3.2f * fonts.caption->FontSize;
  for (const ScreenKey& key : screen.keys) {
    draw_key(page, fonts, c, key, x, y);
    x += gap + key_width(fonts, key);
  }
}

void draw_picture(const Page& page, const ParticipantColours& c, const PracticePicture& scene) {
  const SceneRoom room = participant_scene_room(page.size);
  if (scene.texture != nullptr) page.draw.AddImage(scene.texture, room.min, room.max, {0, 1}, {1, 0});
  page.draw.PushClipRect(room.min, room.max);
  for (const std::vector<ImVec2>& line : scene.lines)
    page.draw.AddPolyline(line.data(), static_cast<int>(line.size()), c.text, 0, std::max(2.0f, 0.005f * page.size.y));
  if (scene.finger_radius > 0.0f)
    page.draw.AddCircle(scene.finger, scene.finger_radius, c.hint, 96, std::max(2.0f, 0.004f * page.size.y));
  page.draw.PopClipRect();
}

/// The start as a ring, the finger as a dot: from in front, right and up. Depth is in words.
void draw_mark(const Page& page, const LargeFonts& fonts, const ParticipantColours& c,
               const ParticipantScreen& screen) {
  const SceneRoom room = participant_scene_room(page.size);
  const ImVec2 middle{0.5f * (room.min.x + room.max.x), 0.5f * (room.min.y + room.max.y)};
  const float half = 0.5f * (room.max.y - room.min.y), per_mm = half / 60.0f, dot = 0.05f * half;
  const float ring = std::max(per_mm * static_cast<float>(screen.mark_mm), 1.6f * dot);
  const auto within = [](double mm, float per, float most) {
    return std::clamp(per * static_cast<float>(mm), -most, most);
  };
  const ImVec2 at{middle.x + within(screen.right_mm, per_mm, 1.6f * half),
                  middle.y - within(screen.up_mm, per_mm, half - dot)};
  page.draw.AddCircle(middle, ring, c.text, 64, std::max(2.0f, 0.012f * half));
  page.draw.AddCircleFilled(at, dot, c.hint, 48);
  if (std::abs(screen.away_mm) > screen.mark_mm)
    page.line(fonts.caption, room.max.y - 1.2f * fonts.caption->FontSize, c.hint,
              screen.away_mm > 0.0 ? "further towards you" : "further away from you");
}

}  // namespace

const ParticipantColours& participant_colours(bool dark) {
  static const ParticipantColours on_dark{ink(0x0B0D0F), ink(0xFFFFFF), ink(0xB8C0C8), ink(0x9AA4AE),
                                          ink(0xFFFFFF), ink(0x0B0D0F), ink(0xFFC857)};
  static const ParticipantColours on_light{ink(0xFFFFFF), ink(0x000000), ink(0x45505A), ink(0x59646E),
                                           ink(0x000000), ink(0xFFFFFF), ink(0x7A3E00)};
  return dark ? on_dark : on_light;
}

SceneRoom participant_scene_room(ImVec2 size) {
  return {{0.15f * size.x, 0.03f * size.y}, {0.85f * size.x, 0.53f * size.y}};
}

void draw_participant_screen(const ParticipantScreen& screen, const LargeFonts& fonts, ImVec2 size, bool dark,
                             const PracticePicture& scene) {
  const ParticipantColours& c = participant_colours(dark);
  const Page page{*ImGui::GetBackgroundDrawList(), size};
  page.draw.AddRectFilled({0, 0}, size, c.ground);
  const bool shows = screen.show_scene && !scene.empty();
  if (shows) draw_picture(page, c, scene);
  if (screen.show_mark) draw_mark(page, fonts, c, screen);
  const bool below = shows || screen.show_mark;
  const ImFont* font = below ? fonts.key : fonts.prompt;
  const float y = page.lines(font, (below ? 0.555f : 0.2f) * size.y, c.text, screen.prompt);
  if (!screen.hint.empty()) page.lines(font, y + (below ? 0.0f : 0.6f * font->FontSize), c.hint, screen.hint);
  draw_keys(page, fonts, c, screen);
  if (screen.trial <= 0) return;
  const std::string count = std::to_string(screen.trial) + (screen.of > 0 ? " of " + std::to_string(screen.of) : "");
  page.line(fonts.caption, size.y - 1.5f * fonts.caption->FontSize, c.dim, count);
}

}  // namespace tangent
