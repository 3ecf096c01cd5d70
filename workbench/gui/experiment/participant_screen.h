// The participant's screen: one prompt in large letters, the keys to press, and, in practice and training alone, the
// scene. Letters are sized by the screen's height: on one that is 30 cm high, capitals are 15 mm, 26 minutes of arc at
// 2 m (20 to 22 are read with ease: ISO 9241-303).
#pragma once

#include "workbench/gui/experiment/screens.h"
#include "workbench/gui/theme/theme.h"

#include <imgui.h>

#include <string>
#include <vector>

namespace tangent {

struct ParticipantColours {
  ImU32 ground, text, dim, key, pressed, on_pressed, hint;
};
const ParticipantColours& participant_colours(bool dark);

/// Where the scene goes, in pixels.
struct SceneRoom {
  ImVec2 min, max;
};
SceneRoom participant_scene_room(ImVec2 size);

/// What may be seen in practice and training: a picture as large as participant_scene_room, its first row below, or
/// lines of a 2D scene with the finger over them, in pixels of the screen.
struct PracticePicture {
  ImTextureID texture = nullptr;
  std::vector<std::vector<ImVec2>> lines;
  ImVec2 finger{0.0f, 0.0f};
  float finger_radius = 0.0f;  ///< 0: none
  bool empty() const { return texture == nullptr && lines.empty(); }
};

/// Draws all over a screen of this size, within a frame. `scene` is drawn only where screen.show_scene says so.
void draw_participant_screen(const ParticipantScreen& screen, const LargeFonts& fonts, ImVec2 size, bool dark,
                             const PracticePicture& scene = {});

}  // namespace tangent
