#pragma once

#include <QStringList>

namespace palp {

/// A page that shows files of pictures and points, which are exported with its charts and tables.
class ExportFiles {
public:
  virtual ~ExportFiles() = default;
  [[nodiscard]] virtual QStringList exportFiles() const = 0;
};

} // namespace palp
