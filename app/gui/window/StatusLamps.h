#pragma once

#include <QObject>
#include <QString>

#include <vector>

class QStatusBar;
class QToolButton;

namespace palp {

class JobRunner;
class JobStrip;
class LiveBoards;
class LiveLamp;

/// A job and the scene that it belongs to.
struct SceneJob {
  JobRunner* runner = nullptr;
  QString scene;
};

/// What is running, in the status line of every scene: the boards that stream, record or give alarm, and all jobs. A
/// click leads to its scene.
class StatusLamps : public QObject {
  Q_OBJECT

public:
  StatusLamps(LiveBoards& live, QStatusBar* bar);

  void setJobs(const std::vector<SceneJob>& jobs);
  [[nodiscard]] bool busy() const;
  /// The jobs of this scene; where it has none that runs, all.
  void cancel(const QString& scene);
  void cancelAll();
  /// A report that runs; empty: none.
  void showReport(const QString& words);

signals:
  void message(const QString& sentence);
  void sceneRequested(const QString& name);

private:
  void displayBoards();

  struct Shown {
    SceneJob job;
    JobStrip* strip = nullptr;
  };
  LiveBoards& live_;
  QStatusBar& bar_;
  std::vector<LiveLamp*> boards_;
  std::vector<Shown> jobs_;
  QToolButton* report_ = nullptr;
};

} // namespace palp
