#pragma once

#include "app/gui/jobs/JobRunner.h"
#include "app/scenes/block/DeformationScene.h"
#include "app/study/touch/Touch.h"

#include <QWidget>

#include <memory>

class QLabel;
class QPushButton;

namespace palp {

class BlockView;

/// The model view: the finite element model under the force that was decoded just now. Meshed and solved only on
/// request.
class LiveModelView : public QWidget {
  Q_OBJECT

public:
  explicit LiveModelView(QWidget* parent = nullptr);
  ~LiveModelView() override;

  /// Solves under the load; `measured` is R / R at rest - 1 of the board, compared with the model's.
  void solve(const SensorDesign& design, const LoadCase& load, const MeshOptions& mesh,
             const Eigen::MatrixXd& measured);
  void setTheme(Theme theme);
  [[nodiscard]] JobRunner& runner() { return runner_; }
  [[nodiscard]] const StageLog& stages() const { return stages_; }
  /// Null before the first.
  [[nodiscard]] const Touch* touch() const;

signals:
  void solveRequested();
  /// The load that was solved, for the Deformation scene.
  void loadRequested(const LoadCase& load);

private:
  struct Result;
  void take(std::shared_ptr<const Result> result);
  void displayWords();
  void draw(bool meshChanged);

  BlockView* view_ = nullptr;
  QLabel* words_ = nullptr;
  QPushButton* use_ = nullptr;
  std::shared_ptr<const Result> result_;
  DeformationOptions options_;
  StageLog stages_;
  JobRunner runner_;
};

} // namespace palp
