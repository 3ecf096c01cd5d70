#include "workbench/gui/platform/save_picture.h"

#include "workbench/gui/model/file_origin_of.h"

#include <algorithm>
#include <cmath>

namespace tangent {

Image cut_out(const Image& whole, const Rect& part, double pixels_per_point) {
  const auto pixel = [&](float points, int most) {
    return std::clamp(static_cast<int>(std::lround(static_cast<double>(points) * pixels_per_point)), 0, most);
  };
  const int x0 = pixel(part.x, whole.width), x1 = pixel(part.right(), whole.width);
  const int y0 = pixel(part.y, whole.height), y1 = pixel(part.bottom(), whole.height);
  Image out{x1 - x0, y1 - y0, {}};
  for (int y = y0; y < y1; ++y) {
    if (x1 > x0)
      out.rgba.insert(out.rgba.end(), whole.at(x0, y), whole.at(x0, y) + 4 * static_cast<std::ptrdiff_t>(x1 - x0));
  }
  return out;
}

void save_picture(AppModel& model, const PictureRequest& request, const Image& whole, double pixels_per_point) {
  const Image picture = cut_out(whole, request.of, pixels_per_point);
  if (picture.rgba.empty()) return;
  if (Status written = write_png(picture, request.path, {.origin = file_origin(model)}); !written)
    model.messages().say(Severity::error, written.error().message());
  else
    model.messages().say(Severity::note, "picture written to " + std::filesystem::absolute(request.path).string());
}

}  // namespace tangent
