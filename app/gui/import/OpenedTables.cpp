#include "app/gui/import/OpenedTables.h"

#include "io/AtomicFile.h"
#include "io/ImportSamples.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"

#include <algorithm>

namespace palp {

namespace fs = std::filesystem;

namespace {

std::vector<TablePreview> previews(const std::vector<fs::path>& files, const TextForm& form,
                                   const std::stop_token& stop) {
  std::vector<TablePreview> tables;
  for (const fs::path& file : files) {
    if (stop.stop_requested()) throw Cancelled();
    tables.push_back(previewTable(file, form));
  }
  return tables;
}

bool sameColumns(const std::vector<TablePreview>& a, const std::vector<TablePreview>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const TablePreview& one, const TablePreview& other) {
    return std::equal(one.columns.begin(), one.columns.end(), other.columns.begin(), other.columns.end(),
                      [](const auto& x, const auto& y) { return x.name == y.name; });
  });
}

/// The number of tables of one recording, and no more than those.
void keepOneRecording(OpenedTables& opened, int count) {
  const auto most = static_cast<int>(opened.tables.size());
  opened.tables.resize(static_cast<std::size_t>(std::clamp(count, 1, most)));
}

/// Throws Error where the map cannot be read.
OpenedTables withMap(const TablesRequest& request, const fs::path& map, const std::stop_token& stop) {
  const std::string text = readFile(map);
  OpenedTables opened{request.files, {}, {}, {"the map " + map.string()}, map};
  ImportDraft draft;
  try {
    draft = importDraft(text, {});
    opened.tables = previews(request.files, draft.form, stop);
    keepOneRecording(opened, request.tablesOfOneRun > 0 ? request.tablesOfOneRun : draft.tables);
    opened.draft = importDraft(text, opened.tables);
  } catch (const Error& error) {
    throw Error(map.string() + ": " + error.what());
  }
  return opened;
}

OpenedTables withGuess(const TablesRequest& request, const TextForm& form, const std::stop_token& stop) {
  OpenedTables opened{request.files, previews(request.files, form, stop), {}, {}, {}};
  keepOneRecording(opened, request.tablesOfOneRun > 0 ? request.tablesOfOneRun
                                                      : static_cast<int>(tablesOfOneRun(opened.tables)));
  const GuessedMap guessed = guessPartOfMap(opened.tables);
  opened.assumed = guessed.assumed;
  opened.draft = importDraft(guessed.json, opened.tables);
  opened.draft.form = form;
  return opened;
}

} // namespace

OpenedTables openTables(const TablesRequest& request, const std::stop_token& stop) {
  if (request.draft) {
    OpenedTables again = withGuess(request, request.draft->form, stop);
    if (!request.before || !sameColumns(again.tables, request.before->tables)) return again;
    again.draft = *request.draft;
    again.assumed = request.before->assumed;
    again.map = request.before->map;
    return again;
  }
  if (!request.map.empty()) return withMap(request, request.map, stop);
  const fs::path beside = mapFileOf(request.files.front());
  std::error_code ignored;
  if (!fs::is_regular_file(beside, ignored)) return withGuess(request, {}, stop);
  try {
    return withMap(request, beside, stop);
  } catch (const Error& error) {
    OpenedTables opened = withGuess(request, {}, stop);
    opened.assumed.insert(opened.assumed.begin(), std::string("the map is not used: ") + error.what());
    return opened;
  }
}

} // namespace palp
