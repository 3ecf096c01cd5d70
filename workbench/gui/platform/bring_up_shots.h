// What the pictures of a bring-up and of a calibration show: the simulated device, each question answered with yes up
// to the one in the picture.
#pragma once

namespace tangent {

class AppModel;

void show_bring_up_home(AppModel& model);    ///< cable, permission and firmware are there; may it home?
void show_bring_up_axes(AppModel& model);    ///< moved by hand: the second direction
void show_bring_up_push(AppModel& model);    ///< before the third push
void show_bring_up_result(AppModel& model);  ///< all steps gone through
void show_calibration(AppModel& model);      ///< before the third reading

}  // namespace tangent
