#pragma once

#include <QTimer>
#include <QWidget>

class QProgressBar;
class QPushButton;
class QToolButton;

namespace palp {

class JobRunner;

/// What a job does, how far it is, and a button that cancels it; hidden while nothing runs, and for work that is done
/// sooner than it could be read.
class JobStrip : public QWidget {
  Q_OBJECT

public:
  explicit JobStrip(JobRunner& runner, QWidget* parent = nullptr);

signals:
  /// A sentence for the status line.
  void message(const QString& sentence);
  /// Its words were clicked on: where the work is done is to be seen.
  void sceneRequested();

private:
  QToolButton* words_ = nullptr;
  QProgressBar* bar_ = nullptr;
  QPushButton* cancel_ = nullptr;
  QTimer wait_;         ///< before it is shown
  bool failed_ = false; ///< the last job, and nothing was begun since
};

} // namespace palp
