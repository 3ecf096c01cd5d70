// Commands and their options. Whoever adds some includes this and not CLI11, which is dear to compile. A number must be
// finite and in its range, a word one of those allowed; anything else is refused with a message that names the option
// and what it allows.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace tangent {

/// A subcommand; `footer` ends its help, in place of the program's.
CLI::App* add_command(CLI::App& app, const std::string& name, const std::string& doc, const std::string& footer = {});

/// What is done when the command is the chosen one and its options are parsed.
void on_run(CLI::App& command, std::function<void()> run);

enum class Needed { no, yes };

/// A text or a path, kept in `value`, which must outlive the parser. `name`: "--out", or "MESH" for one that is known
/// by its position. `shown_as`: "F.csv", in the help.
void add_text_option(CLI::App& app, const std::string& name, std::string& value, const std::string& doc,
                     const std::string& shown_as, Needed needed = Needed::no);
void add_text_option(CLI::App& app, const std::string& name, std::filesystem::path& value, const std::string& doc,
                     const std::string& shown_as, Needed needed = Needed::no);

/// One path or several, known by their position.
void add_paths_option(CLI::App& app, const std::string& name, std::vector<std::filesystem::path>& paths,
                      const std::string& doc, const std::string& shown_as);

/// One that may be given again and again, a value each time; `set` gets them all.
void add_repeated_option(CLI::App& app, const std::string& name, const std::string& doc, const std::string& shown_as,
                         const std::function<void(const std::vector<std::string>&)>& set);

/// One that takes several values in a row, and may be given again; "MESH" for those that are known by their position.
void add_list_option(CLI::App& app, const std::string& name, std::vector<std::string>& values, const std::string& doc,
                     const std::string& shown_as);

void add_flag(CLI::App& app, const std::string& name, bool& value, const std::string& doc);

struct NumberRange {
  double min = 0.0, max = 0.0;  ///< in the option's own unit, both ends allowed
  std::string_view unit = {};
  bool whole = false;
};

/// `set` gets the number in the option's own unit. `name`: "--tolerance-um".
void add_number_option(CLI::App& app, const std::string& name, NumberRange range, const std::string& doc,
                       std::function<void(double)> set);

/// Three numbers, as "--place-offset-mm 1 2 3", each in the range.
void add_vector_option(CLI::App& app, const std::string& name, NumberRange range, const std::string& doc,
                       std::function<void(const std::array<double, 3>&)> set);

/// `set` gets the index into `choices`, which must outlive the parser.
void add_choice_option(CLI::App& app, const std::string& name, std::span<const std::string_view> choices,
                       const std::string& doc, std::function<void(int)> set);

/// Both or neither.
void require_together(CLI::App& app, const std::string& name, const std::string& other);

/// One of them at most.
void exclude_each_other(CLI::App& app, const std::string& name, const std::string& other);

/// Ends the parsing; `why` goes on after the option's name.
[[noreturn]] void refuse_option(const std::string& name, const std::string& why);

struct GivenOption {
  std::string name;  ///< empty: known by its position
  std::string value;
};

/// The options as they were given to a command, in the order of its help.
std::vector<GivenOption> given_options(const CLI::App& command);

}  // namespace tangent
