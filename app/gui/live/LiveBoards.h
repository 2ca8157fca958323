#pragma once

#include "app/gui/live/LivePage.h"
#include "app/study/live/SharedBoards.h"

#include <vector>

class QLabel;
class QPushButton;
class QSplitter;

namespace palp {

/// The Live scene: one board, or several side by side, each with a page, a session and settings of its own. A board
/// costs nothing before the scene is seen, and nothing after it is closed.
class LiveBoards : public Scene {
  Q_OBJECT

public:
  explicit LiveBoards(Workbench& workbench, BoardAccess access = {}, QWidget* parent = nullptr);
  ~LiveBoards() override;

  [[nodiscard]] Stage stage() const override { return Stage::Design; }
  void setTheme(Theme theme) override;
  [[nodiscard]] bool complete() const override;
  [[nodiscard]] std::vector<JobRunner*> runners() override;
  [[nodiscard]] QString commands(const Project& project, const QString& designFile) const override;
  /// There is one at least.
  [[nodiscard]] LivePage& page(std::size_t board = 0) const { return *cells_[board].page; }
  [[nodiscard]] std::size_t count() const { return cells_.size(); }
  /// The status of each board for all scenes, with its number where there are several.
  [[nodiscard]] std::vector<LiveLampState> lamps() const;
  /// Files that are being recorded.
  [[nodiscard]] QStringList recordings() const;

signals:
  void message(const QString& sentence);
  void sceneRequested(const QString& name);
  /// lamps() may say something else.
  void looked();
  void recordingsChanged(const QStringList& files);
  /// A board was added or closed: runners() has changed.
  void countChanged();

protected:
  void showEvent(QShowEvent* event) override;

private:
  struct Cell {
    QWidget* box = nullptr;
    QWidget* head = nullptr; ///< seen where there are several
    QLabel* title = nullptr;
    LivePage* page = nullptr;
  };
  void follow();
  void add();
  void build();
  void remove(LivePage* page);
  void takeAway(std::size_t board);
  void tidy();
  void arrange();
  void displayTitles();
  void tellRecordings();
  [[nodiscard]] LiveSettings settingsOfAnother() const;

  Workbench& workbench_;
  std::shared_ptr<SharedBoards> boards_;
  QSplitter* row_ = nullptr;
  std::vector<Cell> cells_;
  std::vector<LivePage*> leaving_; ///< closed, while their sessions end
  QTimer leavingTimer_;
  QStringList recordings_; ///< at the last report
  int readers_ = 0;        ///< pages that there have been
  Theme theme_ = Theme::Light;
};

} // namespace palp
