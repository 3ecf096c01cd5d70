// Custom widgets: value fields that slide and accept typed values on Enter or when they lose the focus, section
// headings, rows of facts, drawn icons. Each notes itself in the item map.
#pragma once

#include "workbench/gui/widgets/ui_context.h"
#include "workbench/session/safe_range/safe_range.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tangent {

/// A section's title bar; a click folds it, which is kept between runs. Returns whether to draw the contents.
bool section(const UiContext& ui, const char* title, bool open_at_first);

/// A box that shows `text` (a formatted number). Returns the typed text once, on Enter, Tab or a click elsewhere; empty
/// on Escape or when unchanged. `focus`: starts typing now.
std::optional<std::string> number_box(const UiContext& ui, std::string_view path, float width, const std::string& text,
                                      bool focus = false);

/// Slider and number box in one, as in Blender: a filled field with value and unit; dragging slides (with Shift ten
/// times finer), a click types. With the keyboard's focus: Left and Right slide, Enter types.
struct ShareBand {
  float from = 0.0f, to = 0.0f;  ///< share of the slider
  Safety safety = Safety::unknown;
};
/// Along the lower edge of a field: what is known of its values. Told apart by shape as well as by colour: stable is
/// one line, what shakes has teeth, what is not known is dotted.
void draw_bands(const UiContext& ui, ImVec2 at, float width, std::span<const ShareBand> bands);

struct ValueField {
  float width = 100.0f;
  double share = 0.0;  ///< filled share of the range, 0..1
  std::string text;    ///< the value
  std::string_view unit;
  double step = 0.01;  ///< share that an arrow key moves it by, with Shift a tenth
  std::span<const ShareBand> bands = {};
};
struct ValueFieldResult {
  std::optional<double> slid;        ///< new share
  std::optional<std::string> typed;  ///< committed text
};
ValueFieldResult value_field(const UiContext& ui, std::string_view path, const ValueField& field);

enum class Icon {
  first,
  step_back,
  pause,
  play,
  step_forward,
  live,
  previous,
  next,
  reset,
  bookmark,
  bookmark_back,
  bookmark_on,
  record  ///< a red disc
};
/// A square button with a drawn icon; `on` tints it with the accent.
bool icon_button(const UiContext& ui, std::string_view path, Icon icon, const char* tooltip, bool on = false,
                 bool enabled = true);
/// Five points about `centre`, filled.
void draw_star(ImDrawList& draw, ImVec2 centre, float radius, ImU32 ink);
/// A text button that toggles `on`.
bool toggle_button(const UiContext& ui, std::string_view path, const char* text, bool& on, const char* tooltip);
bool text_button(const UiContext& ui, std::string_view path, const char* text, const char* tooltip);
/// Gives the next input field with this label the keyboard from this frame on. (SetKeyboardFocusHere takes two frames
/// more, and text typed meanwhile would be lost.)
void edit_next(const char* label);
/// Whether a field is being edited right now. (io.WantTextInput stays set for a frame after Enter.)
bool text_is_edited();
/// A combo box. While it is open each choice is noted as path/choice. Returns whether another one was chosen; with
/// `again` also when the current one was. With the keyboard's focus: Left and Right choose.
bool choice_row(const UiContext& ui, std::string_view path, float width, std::span<const std::string_view> choices,
                int& chosen, bool again = false);

/// "label ........ value unit": label dim, value in the number font, right-aligned. A label without room is cut short,
/// and whole in a tooltip.
void fact(const UiContext& ui, const char* label, const std::string& value, const char* unit = "",
          std::optional<ImU32> ink = std::nullopt);

/// Shown when the last item is hovered for a moment with no mouse button down; wrapped at a readable width.
void tooltip(const UiContext& ui, std::string_view text);

/// The text, or as much of it as has room, with three dots.
std::string fitted(const ImFont* font, std::string text, float room);
/// The next item goes on in the line if it has this much room there, else below.
void same_line_if_room(float width);
/// Of a text_button.
float button_width(const char* text);

/// printf into a string.
std::string printed(const char* pattern, ...) __attribute__((format(printf, 1, 2)));
/// Six significant digits, no trailing zeros: "0.02", "1e-06", "1234.5".
std::string short_number(double value);

}  // namespace tangent
