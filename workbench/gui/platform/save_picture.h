// Saves a part of the window as a PNG file, from the pixels of the whole window.
#pragma once

#include "workbench/gui/model/app_model.h"
#include "workbench/gui/render/image.h"

namespace tangent {

/// Crops `part` (points) from the whole. Clipped to the image; empty if nothing is left.
Image cut_out(const Image& whole, const Rect& part, double pixels_per_point);

/// Writes the requested picture; a message says where, or why not.
void save_picture(AppModel& model, const PictureRequest& request, const Image& whole, double pixels_per_point);

}  // namespace tangent
