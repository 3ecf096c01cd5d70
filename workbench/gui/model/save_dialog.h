// Where to save a file: a folder that one goes up and down in, a name or a whole path that is typed, and a question
// before a file is written over. No ImGui; the panel draws it (panels/save_panel.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tangent {

/// What is saved.
enum class SaveWhat : std::uint8_t { plots, map, planes, scene, session };

class SaveDialog {
 public:
  struct Entry {
    std::string name;
    bool is_folder = false;
  };

  /// Opens it, in the folder of the last time or else `folder`. `endings`: ".svg", ".pdf"; at least one.
  void ask(SaveWhat what, const std::filesystem::path& folder, std::string stem, std::vector<std::string> endings);
  void close() { open_ = false; }
  bool is_open() const { return open_; }
  SaveWhat what() const { return what_; }

  const std::filesystem::path& folder() const { return folder_; }
  /// Where it can't be read it stays where it is, and problem() says so.
  void go_to(const std::filesystem::path& folder);
  void up() { go_to(folder_.parent_path()); }
  /// Folders, then files with one of the endings, by name; hidden ones are left out.
  const std::vector<Entry>& entries() const { return entries_; }
  /// A folder is gone into, a file's name taken.
  void choose(const Entry& entry);

  std::string name;         ///< typed: a name, or a path from the folder, the root or ~; a folder is gone to
  int width_px = 2400;      ///< of a picture of the scene
  bool transparent = true;  ///< and whether nothing is behind it,
  bool overlay = false;     ///< and labels, scales and colour bar are over it
  const std::vector<std::string>& endings() const { return endings_; }
  std::size_t ending() const;  ///< the name's, by its number; of one without: the first
  void set_ending(std::size_t index);

  /// The file to write, and the dialogue is closed. None: a folder was typed, the name can't be used (problem()), or
  /// the file is there: then asks_to_replace(), and the same again gives it.
  std::optional<std::filesystem::path> accept();
  bool asks_to_replace() const;
  const std::string& problem() const { return problem_; }

 private:
  std::filesystem::path typed() const;

  bool open_ = false;
  SaveWhat what_ = SaveWhat::plots;
  std::filesystem::path folder_, asked_for_;
  std::vector<std::string> endings_;
  std::vector<Entry> entries_;
  std::string problem_;
};

}  // namespace tangent
