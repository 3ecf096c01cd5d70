// The right column's tabs: one a task, with the sections that it needs; and one with all of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tangent {

enum class Task : std::uint8_t { look, tune, devices, record, all };
inline constexpr std::array<std::string_view, 5> kTaskNames{"look", "tune", "devices", "record", "all"};

struct TaskSection {
  std::string_view title;
  Task task;
};
/// In the order of the tab `all`. Every section is in one task.
inline constexpr std::array<TaskSection, 15> kTaskSections{{{"Iterations", Task::look},
                                                            {"Why this tick", Task::look},
                                                            {"Time machine", Task::tune},
                                                            {"Tune", Task::tune},
                                                            {"Sweep", Task::tune},
                                                            {"Speed against error", Task::tune},
                                                            {"Bookmarks", Task::record},
                                                            {"Compare recordings", Task::record},
                                                            {"Map", Task::tune},
                                                            {"Smoothness as felt", Task::tune},
                                                            {"Inspect", Task::look},
                                                            {"Mesh", Task::look},
                                                            {"Devices", Task::devices},
                                                            {"Recording", Task::record},
                                                            {"Messages", Task::record}}};

constexpr bool shows(Task tab, std::string_view title) {
  for (const TaskSection& section : kTaskSections)
    if (section.title == title) return tab == Task::all || tab == section.task;
  return false;
}
/// The tab that shows the section, `now` where it does.
constexpr Task task_with(std::string_view title, Task now) {
  for (const TaskSection& section : kTaskSections)
    if (section.title == title && !shows(now, title)) return section.task;
  return now;
}

}  // namespace tangent
