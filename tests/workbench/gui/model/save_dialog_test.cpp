#include "workbench/gui/model/save_dialog.h"

#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <fstream>
#include <string>

using namespace tangent;
using tangent::testing::TempFolder;

namespace {

/// A folder with two folders and three files, and a dialogue for .svg and .pdf in it.
struct Place {
  TempFolder temp;
  std::filesystem::path folder = std::filesystem::canonical(temp.path());
  SaveDialog dialog;

  Place() {
    std::filesystem::create_directories(folder / "b" / "inner");
    std::filesystem::create_directory(folder / "a");
    for (const char* name : {"z.svg", "old.pdf", "notes.txt", ".hidden.svg"}) std::ofstream(folder / name) << "x";
    dialog.ask(SaveWhat::plots, folder, "plots", {".svg", ".pdf"});
  }
  std::string names() const {
    std::string all;
    for (const SaveDialog::Entry& entry : dialog.entries()) all += entry.name + (entry.is_folder ? "/ " : " ");
    return all;
  }
};

}  // namespace

TEST_CASE("a save dialogue lists folders, then files of its kinds, and goes into them and up") {
  Place place;
  CHECK(place.dialog.is_open());
  CHECK(place.dialog.name == "plots.svg");
  CHECK(place.names() == "a/ b/ old.pdf z.svg ");
  place.dialog.choose({"b", true});
  CHECK(place.names() == "inner/ ");
  place.dialog.up();
  CHECK(place.dialog.folder() == place.folder);
  place.dialog.choose({"old.pdf", false});
  CHECK(place.dialog.name == "old.pdf");
  for (int i = 0; i < 40; ++i) place.dialog.up();
  CHECK(place.dialog.folder() == "/");
  place.dialog.go_to("/nowhere/at/all");
  CHECK(place.dialog.problem().find("/nowhere/at/all") != std::string::npos);
  CHECK(place.dialog.folder() == "/");
}

TEST_CASE("a file that is there is written over only when asked twice, and not under another name") {
  Place place;
  place.dialog.name = "old.pdf";
  CHECK_FALSE(place.dialog.accept());
  CHECK(place.dialog.asks_to_replace());
  place.dialog.name = "z.svg";
  CHECK_FALSE(place.dialog.asks_to_replace());
  CHECK_FALSE(place.dialog.accept());
  CHECK(place.dialog.accept() == place.folder / "z.svg");
  CHECK_FALSE(place.dialog.is_open());
}

TEST_CASE("a typed path is followed: a folder is gone to, a missing one is said, an ending is added") {
  Place place;
  place.dialog.name = (place.folder / "b").string();
  CHECK_FALSE(place.dialog.accept());
  CHECK(place.dialog.folder() == place.folder / "b");
  CHECK(place.dialog.name.empty());
  CHECK_FALSE(place.dialog.accept());
  CHECK(place.dialog.problem() == "type a name");
  place.dialog.name = "missing/x.svg";
  CHECK_FALSE(place.dialog.accept());
  CHECK(place.dialog.problem().find("no such folder") != std::string::npos);
  place.dialog.name = "../figure 1.5";
  CHECK(place.dialog.accept() == place.folder / "b" / "../figure 1.5.svg");
  place.dialog.ask(SaveWhat::plots, "/", "plots", {".svg", ".pdf"});
  CHECK(place.dialog.folder() == place.folder);  // of the last time
}

TEST_CASE("the kind of file is the ending of its name, and changing it changes the name") {
  Place place;
  CHECK(place.dialog.ending() == 0);
  place.dialog.set_ending(1);
  CHECK(place.dialog.name == "plots.pdf");
  place.dialog.name = "v1.2";
  place.dialog.set_ending(1);
  CHECK(place.dialog.name == "v1.2.pdf");
  CHECK(place.dialog.ending() == 1);
}
