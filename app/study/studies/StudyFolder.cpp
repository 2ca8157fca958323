#include "app/study/studies/StudyFolder.h"

#include "app/study/reports/Csv.h"
#include "app/study/studies/StudyRow.h"
#include "io/AtomicFile.h"
#include "model/base/Error.h"

#include <algorithm>

namespace palp {

namespace fs = std::filesystem;

StudyFolder::StudyFolder(fs::path folder, StudyPlan plan) : folder_(std::move(folder)), plan_(std::move(plan)) {
  const fs::path file = folder_ / "study.json";
  const std::string content = toJson(plan_);
  if (fs::exists(file)) {
    if (readFile(file) != content)
      throw Error(folder_.string() + ": holds another study (study.json differs); allowed is a new folder, or the same "
                                     "study to go on with it");
    makeRows();
    return;
  }
  if (fs::exists(folder_) && !fs::is_directory(folder_))
    throw Error(folder_.string() + ": is a file; allowed is a folder");
  if (fs::exists(folder_) && !fs::is_empty(folder_))
    throw Error(folder_.string() + ": is not empty and holds no study; allowed is a new folder");
  makeRows();
  writeFile(file, content, true); // another shard may have written the same just now
}

void StudyFolder::makeRows() const {
  std::error_code failed;
  fs::create_directories(folder_ / "rows", failed);
  if (failed) throw Error(folder_.string() + ": the folder cannot be made: " + failed.message());
}

fs::path StudyFolder::row(std::size_t design) const {
  const std::string number = std::to_string(design);
  return folder_ / "rows" / (std::string(7 - std::min<std::size_t>(7, number.size()), '0') + number + ".csv");
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
                          const std::stop_token& stop) {
  std::vector<std::size_t> missing;
  for (std::size_t i = first; i < last; ++i)
    if (!done(i)) missing.push_back(i);
  const auto tell = [&](double of, const std::string& what) {
    if (progress) progress(of / static_cast<double>(missing.size()), what);
  };
  for (std::size_t k = 0; k < missing.size(); ++k) {
    if (stop.stop_requested()) return false;
    const std::string design = "design " + std::to_string(missing[k]);
    const auto before = static_cast<double>(k);
    const auto found = studyRow(
        plan_, missing[k], threads,
        [&](double share, const std::string& what) { tell(before + share, design + ": " + what); }, stop);
    if (!found) return false;
    writeFile(row(missing[k]), studyLine(plan_, missing[k], *found), true); // whole or not at all
    tell(before + 1, design);
  }
  return true;
}

void StudyFolder::writeTable() const {
  std::string all = Csv(studyColumns(plan_)).text();
  for (std::size_t i = 0; i < plan_.designs(); ++i) {
    const std::string line = readFile(row(i));
    if (!line.starts_with(std::to_string(i) + ",") || line.back() != '\n')
      throw Error(row(i).string() + ": no row of design " + std::to_string(i) + "; take it away to have it made again");
    all += line;
  }
  writeFile(table(), all, true);
}

} // namespace palp
