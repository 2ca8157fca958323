#pragma once

#include "app/gui/project/Project.h"
#include "app/scenes/Palette.h"
#include "app/study/touch/Touch.h"

#include <QString>
#include <QWidget>

#include <functional>
#include <utility>
#include <vector>

namespace palp {

class JobRunner;

/// A page of the window; hidden pages draw and compute nothing.
class Scene : public QWidget {
public:
  using QWidget::QWidget;

  /// The furthest stage of the chain that the page shows.
  [[nodiscard]] virtual Stage stage() const = 0;
  virtual void setTheme(Theme theme) = 0;
  /// True where all that the page shows at the start is there.
  [[nodiscard]] virtual bool complete() const = 0;
  /// The page's own background work: the window shows its progress, and Esc cancels it.
  [[nodiscard]] virtual std::vector<JobRunner*> runners() { return {}; }
  /// The palp commands that do what the page shows, one a line; empty where there are none.
  [[nodiscard]] virtual QString commands(const Project&, const QString& /*designFile*/) const { return {}; }

  /// Whom its tables and charts ask, when they are saved, for lines that say what they were made with.
  void setExportSource(std::function<QString(const QWidget&)> source) { source_ = std::move(source); }
  [[nodiscard]] QString exportSource(const QWidget& saved) const { return source_ ? source_(saved) : QString(); }

private:
  std::function<QString(const QWidget&)> source_;
};

} // namespace palp
