// Pictures of the scene without a window: transparent ground, any size, and the command that makes them again.
#include "workbench/gui/platform/shots.h"

#include "workbench/gui/platform/offscreen.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace tangent;

namespace {

bool no_gl() {
  const auto context = OffscreenContext::open();
  if (!context) MESSAGE("skipped: " << context.error().message());
  return !context;
}

ShotRequest cone(int width, int height) {
  ShotRequest request;
  request.view = "cone";
  request.width_px = width;
  request.height_px = height;
  return request;
}

}  // namespace

TEST_CASE("colour and alpha come back from what they look like over black and over white") {
  Image black{256, 256, {}}, white = black;
  const auto over = [](int colour, int alpha, int ground) {
    return static_cast<std::uint8_t>(std::lround((colour * alpha + ground * (255 - alpha)) / 255.0));
  };
  for (int alpha = 0; alpha < 256; ++alpha)
    for (int colour = 0; colour < 256; ++colour)
      for (const int channel : {colour, 255 - colour, 128, 255}) {
        black.rgba.push_back(over(channel, alpha, 0));
        white.rgba.push_back(over(channel, alpha, 255));
      }
  const Image found = with_alpha_of(black, white);
  int furthest = 0;
  for (int alpha = 0; alpha < 256; ++alpha)
    for (int colour = 0; colour < 256; ++colour) {
      const std::uint8_t* pixel = found.at(colour, alpha);
      // Two roundings of half a step each; what colour it is matters as much as there is of it.
      furthest = std::max(furthest, std::abs(pixel[3] - alpha));
      furthest = std::max(furthest, std::abs(pixel[0] * pixel[3] - colour * alpha) / 255);
    }
  CHECK(furthest <= 1);
}

TEST_CASE("a transparent picture has nothing in its corners, all of the body in its middle, and the same colours") {
  if (no_gl()) return;
  ShotRequest request = cone(240, 180);
  const Result<Shot> opaque = take_shot(request);
  request.transparent = true;
  const Result<Shot> clear = take_shot(request);
  REQUIRE(opaque);
  REQUIRE(clear);
  int empty = 0, full = 0, other = 0;
  for (int y = 0; y < 180; ++y)
    for (int x = 0; x < 240; ++x) {
      const std::uint8_t *a = clear->image.at(x, y), *b = opaque->image.at(x, y);
      empty += a[3] == 0;
      full += a[3] == 255;
      for (int k = 0; k < 3 && a[3] == 255; ++k) other += std::abs(a[k] - b[k]) > 1;
    }
  CHECK(clear->image.at(0, 0)[3] == 0);
  CHECK(clear->image.at(239, 0)[3] == 0);
  CHECK(empty > 240 * 180 / 5);
  CHECK(full > 240 * 180 / 10);
  CHECK(other == 0);
}

TEST_CASE("a shot knows its mesh, and its command says every choice") {
  if (no_gl()) return;
  ShotRequest request = cone(200, 144);
  request.view = "normals";
  request.mesh = "torus";
  request.transparent = request.y_up = true;
  const Result<Shot> shot = take_shot(request);
  REQUIRE(shot);
  CHECK(shot->origin.mesh.find("torus, ") == 0);
  CHECK(shot->origin.command ==
        "workbench shot torus --view normals --width 200 --height 144 --scale 1 --theme light --up y --transparent");
}

TEST_CASE("the window has no transparent ground, and says so") {
  ShotRequest request;
  request.view = "overview";
  request.transparent = true;
  const Result<Shot> shot = take_shot(request);
  REQUIRE_FALSE(shot);
  CHECK(shot.error().message().find("--transparent") != std::string::npos);
}
