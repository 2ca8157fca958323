#include "io/ImportDraft.h"
#include "io/measured/MeasuredTable.h"
#include "io/measured/Units.h"

#include <algorithm>

namespace palp {

namespace fs = std::filesystem;

namespace {

TableForm tableForm(const TextForm& form) {
  TableForm made;
  if (form.separator != 0) made.separator = form.separator;
  if (form.decimal != 0) made.decimal = form.decimal;
  if (form.namesLine >= 0) made.namesLine = form.namesLine;
  if (form.firstLine > 0) made.firstLine = form.firstLine;
  return made;
}

bool sameColumns(const TablePreview& a, const TablePreview& b) {
  const auto named = [](const TablePreview::Column& column) { return !column.name.empty(); };
  return std::any_of(a.columns.begin(), a.columns.end(), named) &&
         std::equal(a.columns.begin(), a.columns.end(), b.columns.begin(), b.columns.end(),
                    [](const auto& one, const auto& other) { return one.name == other.name; });
}

} // namespace

TablePreview previewTable(const fs::path& file, const TextForm& form, std::size_t rows) {
  const auto table = openTable(file, tableForm(form));
  TablePreview preview{file, table->form(), table->before(), {}, {}, {}};
  const std::vector<std::string>& names = table->columns();
  const std::vector<std::string> units = table->units();
  for (std::size_t i = 0; i < names.size(); ++i) {
    auto unit = knownUnit(units[i]);
    if (!unit) unit = unitInName(names[i]);
    preview.columns.push_back({names[i], unit ? unit->name : "", table->isDate(i)});
  }
  for (const TableArray& array : table->arrays())
    preview.arrays.push_back({array.name, array.rows, array.firstColumn, array.columns});
  if (rows > 0) preview.rows = table->firstRows(rows);
  return preview;
}

fs::path mapFileOf(const fs::path& table) {
  fs::path map = table;
  return map += ".map.json";
}

std::size_t tablesOfOneRun(const std::vector<TablePreview>& tables) {
  for (std::size_t t = 1; t < tables.size(); ++t)
    if (sameColumns(tables[t], tables[0])) return t;
  return std::max<std::size_t>(1, tables.size());
}

} // namespace palp
