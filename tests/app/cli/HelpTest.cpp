#include "tests/app/cli/Process.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

// What every command says by --help, read as its users do.

namespace {

constexpr std::size_t kColumn = 30; ///< where descriptions begin

/// A positional argument or an option, as --help shows it.
struct Shown {
  std::string heading, name, type, what;
};

std::vector<std::string> linesOfHelp(const std::vector<std::string>& arguments) {
  std::istringstream text(palp::test::palp(arguments).output);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> commandsOfHelp() {
  std::vector<std::string> names;
  bool below = false;
  for (const std::string& line : linesOfHelp({"--help"})) {
    if (line == "Subcommands:") below = true;
    if (below && line.empty()) break;
    if (below && line.starts_with("  ")) names.push_back(line.substr(2, line.find(' ', 2) - 2));
  }
  return names;
}

/// The line's name and type, and its description, which follows on the next line where there is no room.
Shown shownAt(const std::vector<std::string>& lines, std::size_t i, const std::string& heading) {
  const bool below =
      lines[i].size() >= kColumn && i + 1 < lines.size() && lines[i + 1].starts_with(std::string(kColumn, ' '));
  std::istringstream left(below ? lines[i] : lines[i].substr(0, kColumn));
  Shown shown{
      heading, {}, {}, below ? lines[i + 1].substr(kColumn) : lines[i].substr(std::min(lines[i].size(), kColumn))};
  left >> shown.name >> shown.type;
  if (shown.type.ends_with(":")) shown.type.clear(); // "Needs: ..."
  return shown;
}

std::vector<Shown> shownBy(const std::vector<std::string>& lines) {
  std::vector<Shown> all;
  std::string heading;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!lines[i].starts_with(" ") && lines[i].ends_with(":")) heading = lines[i];
    if (lines[i].starts_with("  ") && lines[i].substr(0, 3) != "   ") all.push_back(shownAt(lines, i, heading));
  }
  return all;
}

} // namespace

TEST(Help, OfEachCommandBeginsWithASentenceAndEndsWithOneExample) {
  const std::vector<std::string> commands = commandsOfHelp();
  EXPECT_GT(commands.size(), 10U);
  for (const std::string& command : commands) {
    SCOPED_TRACE(command);
    const std::vector<std::string> lines = linesOfHelp({command, "--help"});
    ASSERT_FALSE(lines.empty());
    EXPECT_TRUE(std::regex_match(lines.front(), std::regex("[A-Z][^.]*[a-z]\\."))) << lines.front();
    EXPECT_EQ(lines.back().rfind("Example: palp " + command, 0), 0U) << lines.back();
  }
}

TEST(Help, EachOptionHasAHeadingATypeAndADescription) {
  const std::set<std::string> flags{
      "--bare",   "--check",          "--dark",      "--dry-run",      "--force",
      "--json",   "--list",           "--resubmit",  "--send-to-many", "--simulate",
      "--submit", "--retry-problems", "--surrogate", "-h,--help",      "--leave-out-bad-rows"};
  const std::regex type("[A-Z][A-Z0-9_.,:/@=x\\[\\]mu-]*(:\\{.*\\}|:INT)?(=.*)?");
  for (const std::string& command : commandsOfHelp())
    for (const Shown& option : shownBy(linesOfHelp({command, "--help"}))) {
      SCOPED_TRACE(command + " " + option.name + " " + option.type);
      EXPECT_NE(option.heading, "Options:") << "the heading of options without a group";
      EXPECT_GT(option.what.size(), 8U) << option.what;
      EXPECT_TRUE(flags.contains(option.name) || std::regex_match(option.type, type));
    }
}
