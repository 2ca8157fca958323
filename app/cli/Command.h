#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace palp {

/// An option of a command, as far as its rules are concerned. CLI11 lies in headers alone and is included by
/// Command.cpp and Cli.cpp only: copied into every command it was a fifth of all the code that the compiler had to
/// write.
class Option {
public:
  explicit Option(CLI::Option* option) : option_(option) {}
  Option required();
  Option needs(Option other);
  Option excludes(Option other);
  Option oneOf(const std::vector<std::string>& allowed);
  Option byDefault(const std::string& value); ///< set, and shown by --help
  Option oneValueEach();                      ///< given again for each further value

private:
  CLI::Option* option_;
};

/// A command's options; each writes what was given into a variable, which must outlive the parsing. `type` is the form
/// of the value in --help: FILE, FOLDER, DESIGN (a file, or paper), NUMBER, N (a whole number), TEXT, or a form of its
/// own in capitals, "AREA:FX,FY,FZ".
class Command {
public:
  explicit Command(CLI::App* app) : app_(app) {}
  /// The heading in --help of the options that are declared from here on.
  void group(const std::string& heading);
  Option flag(const std::string& names, bool& value, const std::string& what);
  Option option(const std::string& names, std::string& value, const char* type, const std::string& what);
  Option option(const std::string& names, std::filesystem::path& value, const char* type, const std::string& what);
  Option option(const std::string& names, std::vector<std::string>& values, const char* type, const std::string& what);

  /// Words and options that this command does not know, in their order, for another one.
  void rest(std::vector<std::string>& words);

private:
  CLI::App* app_;
};

} // namespace palp
