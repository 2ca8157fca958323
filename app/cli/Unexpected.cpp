#include "app/cli/Unexpected.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <numeric>
#include <vector>

namespace palp {

namespace {

/// Letters that are inserted, left out or exchanged between both words (Wagner and Fischer, 1974).
std::size_t editsBetween(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t exchanged = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, exchanged});
    }
  }
  return row.back();
}

std::vector<std::string> knownWords(const CLI::App& command, bool option) {
  std::vector<std::string> words;
  if (option) {
    for (const CLI::Option* known : command.get_options())
      for (const std::string& name : known->get_lnames()) words.push_back("--" + name);
  } else {
    for (const CLI::App* known : command.get_subcommands([](const CLI::App*) { return true; }))
      words.push_back(known->get_name());
  }
  return words;
}

} // namespace

std::string unexpectedInWords(const CLI::App& command) {
  const std::vector<std::string> left = command.remaining();
  if (left.empty()) return {};
  const std::string word = left.front().substr(0, left.front().find('='));
  std::string words = "'" + word + "' is not expected here";
  const std::vector<std::string> known = knownWords(command, word.starts_with('-'));
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
    return editsBetween(word, a) < editsBetween(word, b);
  });
  if (nearest != known.end() && 3 * editsBetween(word, *nearest) <= word.size())
    words += "; did you mean " + *nearest + "?";
  return words;
}

} // namespace palp
