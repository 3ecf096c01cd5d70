#include "tests/workbench/gui/headless_app.h"
#include "workbench/gui/panels/panels.h"

#include <filesystem>
#include <fstream>

using namespace tangent;
using tangent::test::HeadlessApp;

namespace {

std::filesystem::path folder_with_meshes() {
  const auto folder = std::filesystem::temp_directory_path() / "tangent_path_bar";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder / "parts");
  for (const char* name : {"bracket.obj", "bracket_old.OBJ", "notes.txt", ".hidden.obj", "wheel.stl"}) {
    std::ofstream(folder / name) << "v 0 0 0\nv 50 0 0\nv 0 50 0\nf 1 2 3\n";
  }
  return folder;
}

}  // namespace

TEST_CASE("completion offers meshes and folders that begin with what was typed") {
  const std::string at = folder_with_meshes().string() + "/";
  CHECK(complete_mesh_path(at, 100) ==
        std::vector<std::string>{at + "bracket.obj", at + "bracket_old.OBJ", at + "parts/", at + "wheel.stl"});
  CHECK(complete_mesh_path(at + "br", 100).size() == 2);
  CHECK(common_start(complete_mesh_path(at + "b", 100)) == at + "bracket");
  CHECK(complete_mesh_path(at + ".h", 100).size() == 1);
  CHECK(complete_mesh_path("/nowhere/at/all/", 100).empty());
  CHECK(common_start({}).empty());
}

TEST_CASE("a path typed with Tab and Enter opens the mesh") {
  const std::string at = folder_with_meshes().string() + "/";
  HeadlessApp ui;
  ui.click("menu/file");
  ui.click("menu/file/open");
  ui.frames(2);
  ui.type((at + "w").c_str());
  ui.key(HeadlessApp::kTab);
  ui.frame();
  ui.key(HeadlessApp::kEnter);
  ui.frame();
  CHECK(ui.app().items().find("path_bar/text") == nullptr);
  bool named = false;  // an OBJ's text is no STL: what counts is that it was tried
  for (const Message& m : ui.model().messages().all()) named |= m.text.find("wheel.stl") != std::string::npos;
  CHECK(named);
  ui.click("menu/file");
  ui.click("menu/file/open");
  ui.frames(2);
  ui.type((at + "bracket.obj").c_str());
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().scene().current()->mesh().usable_triangle_count() == 1);
}
