// A part of the window as a PNG file, from the pixels of the whole.
#pragma once

#include "workbench/gui/model/app_model.h"
#include "workbench/gui/render/image.h"

namespace tangent {

/// `pixels_per_point`: of the whole. Cut to the image; empty where nothing is left.
Image cut_out(const Image& whole, const Rect& part, double pixels_per_point);

/// Writes what was asked for; a message says where, or why not.
void save_picture(AppModel& model, const PictureRequest& request, const Image& whole, double pixels_per_point);

}  // namespace tangent
