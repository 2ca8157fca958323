#pragma once

#include <QString>

namespace palp {

struct Imported;
struct OpenedTables;

/// What the tables are: how their text is read, the lines above them, their columns, further recordings; a line each.
QString tablesWords(const OpenedTables& opened);

/// What would be imported, and how: samples, rows left out, warnings, notes. `result`: of the check; nullptr: none yet.
QString verdictWords(const OpenedTables& opened, const Imported* result);

} // namespace palp
