#include "app/study/studies/StudyFolder.h"

#include "app/study/Version.h"
#include "app/study/reports/Csv.h"
#include "app/study/studies/StudyRow.h"
#include "io/AtomicFile.h"
#include "io/CsvText.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"

#include <algorithm>
#include <map>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr const char *kStudyFile = "study.json", *kRows = "rows";
constexpr const char* kMadeBy = "# program: "; // second line of a row's file

/// Who made a row, from the text below its line.
std::string madeBy(const std::string& content) {
  const std::string below = content.substr(content.find('\n') + 1);
  if (!below.starts_with(kMadeBy)) return "an older palp";
  return below.substr(std::string(kMadeBy).size(), below.find('\n') - std::string(kMadeBy).size());
}

/// What a shard that has just begun in the same folder may have made before the file of the study.
bool isOfShard(const std::string& name) {
  return name == kRows || name.starts_with(".study.new"); // as AtomicFile calls it
}

} // namespace

void StudyFolder::requireFits(const fs::path& folder, const StudyPlan& plan) {
  const auto refuse = [&](const std::string& sentence) { throw Error(folder.string() + ": " + sentence); };
  std::error_code failed;
  const fs::file_status status = fs::status(folder, failed);
  if (!fs::exists(status)) return; // where it cannot be made, its maker reports why
  if (!fs::is_directory(status)) refuse(gotExpected("a file", "a folder"));
  const fs::path file = folder / kStudyFile;
  if (fs::exists(file, failed)) {
    // By content: spaces, and keys that a version left out, say nothing.
    if (toJson(parseStudy(readFile(file), file.string())) != toJson(plan))
      refuse("contains another study (study.json differs); expected a new folder, or the same study to continue it");
    return;
  }
  fs::directory_iterator entries(folder, failed);
  if (failed) refuse("the folder cannot be read: " + failed.message());
  for (const fs::directory_entry& entry : entries)
    if (!isOfShard(entry.path().filename().string()))
      refuse("is not empty and contains no study; expected a new folder");
}

StudyFolder::StudyFolder(fs::path folder, StudyPlan plan)
    : folder_(std::move(folder)), plan_(std::move(plan)), areas_(studyAreas(plan_)),
      columns_(studyColumns(plan_, areas_)) {
  requireFits(folder_, plan_);
  std::error_code failed;
  fs::create_directories(folder_ / kRows, failed);
  if (failed) throw Error(folder_.string() + ": the folder cannot be created: " + failed.message());
  requireWritable(row(0), true); // refused before the work
  removeLeftovers(folder_);
  if (!fs::exists(folder_ / kStudyFile)) // another shard may have written the same just now
    writeFile(folder_ / kStudyFile, toJson(plan_, program()), true);
}

fs::path StudyFolder::row(std::size_t design) const {
  const std::string number = std::to_string(design);
  return folder_ / kRows / (std::string(7 - std::min<std::size_t>(7, number.size()), '0') + number + ".csv");
}

bool StudyFolder::done(std::size_t design) const {
  return fs::exists(row(design));
}

std::size_t StudyFolder::rowsDone() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < plan_.designs(); ++i) count += done(i) ? 1 : 0;
  return count;
}

bool StudyFolder::compute(std::size_t first, std::size_t last, int threads, const ReportProgress& progress,
                          const std::stop_token& stop, bool retryProblems) {
  std::vector<std::size_t> missing;
  for (std::size_t i = first; i < last; ++i)
    if (!done(i) || (retryProblems && hasProblem(i))) missing.push_back(i);
  const auto tell = [&](double of, const std::string& what) {
    if (progress) progress(of / static_cast<double>(missing.size()), what);
  };
  for (std::size_t k = 0; k < missing.size(); ++k) {
    if (stop.stop_requested()) return false;
    const std::string design = "design " + std::to_string(missing[k]);
    const auto before = static_cast<double>(k);
    const auto found = studyRow(
        plan_, missing[k], areas_, threads,
        [&](double share, const std::string& what) { tell(before + share, design + ": " + what); }, stop);
    if (!found) return false;
    const std::string text = studyLine(plan_, columns_, missing[k], *found) + kMadeBy + programHere() + "\n";
    writeFile(row(missing[k]), text, true); // complete or not at all
    tell(before + 1, design);
  }
  return true;
}

std::string StudyFolder::line(std::size_t design) const {
  const std::string content = readFile(row(design));
  const std::string line = content.substr(0, content.find('\n') + 1), below = content.substr(line.size());
  const std::vector<std::string> cells = csvFields(line);
  const bool whole = below.empty() || (below.starts_with(kMadeBy) && below.find('\n') + 1 == below.size());
  if (cells.size() != columns_.size() || cells[0] != std::to_string(design) || line.empty() || !whole)
    throw Error(row(design).string() + ": no row of design " + std::to_string(design) +
                "; remove the file to compute it again");
  return line;
}

bool StudyFolder::hasProblem(std::size_t design) const {
  return !csvFields(line(design))[1 + plan_.axes.size()].empty();
}

std::string StudyFolder::mixedPrograms() const {
  std::map<std::string, std::size_t> rows;
  for (std::size_t i = 0; i < plan_.designs(); ++i) ++rows[done(i) ? madeBy(readFile(row(i))) : programHere()];
  if (rows.size() < 2) return {};
  std::string words = "the rows were computed by several programs, whose results may differ:";
  for (const auto& [by, count] : rows) words += " " + std::to_string(count) + " of " + by + ",";
  words.back() = ';';
  return words + " a new folder has all rows of one program";
}

void StudyFolder::writeTable() const {
  std::string all = Csv(columns_).text();
  for (std::size_t i = 0; i < plan_.designs(); ++i) all += line(i);
  writeFile(table(), all, true);
}

} // namespace palp
