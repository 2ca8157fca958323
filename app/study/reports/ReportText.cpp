#include "app/study/reports/ReportText.h"

#include "app/study/Resources.h"
#include "io/AtomicFile.h"
#include "model/base/Error.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace palp {

ReportText::ReportText(const std::string& report) : file_("reports/" + report + ".md") {
  std::istringstream lines(readFile(resource(file_)));
  std::string* text = nullptr;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## ")) {
      const auto [place, added] = texts_.emplace(line.substr(3), "");
      if (!added) throw Error(file_ + ": key " + line.substr(3) + " appears twice");
      text = &place->second;
    } else if (text != nullptr && !line.empty()) {
      *text += (text->empty() ? "" : " ") + line;
    }
  }
  for (const auto& [key, words] : texts_)
    if (words.empty()) throw Error(file_ + ": key " + key + " has no text");
}

std::string ReportText::operator()(const std::string& key, const Values& values) const {
  const std::vector<std::string> wanted = names(key);
  for (const auto& [name, value] : values)
    if (std::find(wanted.begin(), wanted.end(), name) == wanted.end())
      throw std::logic_error(file_ + ": " + key + " has no {" + name + "}");
  std::string filled;
  const std::string& words = text(key);
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t open = words.find('{', at), close = words.find('}', open);
    filled += words.substr(at, open - at);
    if (open == std::string::npos) break;
    const auto value = values.find(words.substr(open + 1, close - open - 1));
    if (value == values.end())
      throw std::logic_error(file_ + ": " + key + " lacks " + words.substr(open, close - open));
    filled += value->second.text();
    at = close + 1;
  }
  return filled;
}

ReportTable ReportText::table(const std::string& key, const Values& values) const {
  const std::string parts = (*this)(key, values), separator = " | ";
  std::size_t end = parts.find(separator);
  ReportTable table{.caption = parts.substr(0, end)};
  while (end != std::string::npos) {
    const std::size_t start = end + separator.size();
    end = parts.find(separator, start);
    table.heads.push_back(parts.substr(start, end - start));
  }
  return table;
}

ReportChart ReportText::chart(const std::string& file, const std::string& key, const Values& values) const {
  const ReportTable parts = table(key, values);
  if (parts.heads.size() != 3)
    throw std::logic_error(file_ + ": " + key + " needs caption | title | x label | y label");
  return {.file = file,
          .caption = parts.caption,
          .title = parts.heads[0],
          .xLabel = parts.heads[1],
          .yLabel = parts.heads[2]};
}

std::vector<std::string> ReportText::keys() const {
  std::vector<std::string> all;
  for (const auto& [key, words] : texts_) all.push_back(key);
  return all;
}

std::vector<std::string> ReportText::names(const std::string& key) const {
  const std::string& words = text(key);
  std::vector<std::string> found;
  for (std::size_t open = words.find('{'); open != std::string::npos; open = words.find('{', open + 1)) {
    const std::size_t close = words.find('}', open);
    if (close == std::string::npos) throw Error(file_ + ": " + key + ": { without }");
    found.push_back(words.substr(open + 1, close - open - 1));
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

const std::string& ReportText::text(const std::string& key) const {
  const auto found = texts_.find(key);
  if (found == texts_.end()) throw std::logic_error(file_ + ": no key " + key);
  return found->second;
}

} // namespace palp
