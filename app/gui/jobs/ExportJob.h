#pragma once

#include "app/gui/jobs/JobRunner.h"

#include <string>

namespace palp {

/// Writes files in the background, one after the other: the complete content is made first, then moved to its path in
/// once, so that a stop or a failure leaves nothing half-written.
class ExportJob : public QObject {
  Q_OBJECT

public:
  explicit ExportJob(QObject* parent = nullptr);

  /// Makes the content on copies of its inputs; throws Cancelled where it is stopped, Error where there is none.
  using Making = std::function<std::string(const std::stop_token&)>;
  void write(const QString& file, Making make);
  [[nodiscard]] JobRunner& runner() { return runner_; }

signals:
  void done(const QString& sentence);

private:
  JobRunner runner_{JobRunner::Orders::Each};
};

} // namespace palp
