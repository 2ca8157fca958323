#pragma once

#include <QWidget>

class QLabel;
class QPushButton;

namespace palp {

class TouchSession;
struct ReferencePath;
struct Project;

/// The results of the solve as text, the estimate of its error, and the probed point.
class ResultPanel : public QWidget {
  Q_OBJECT

public:
  explicit ResultPanel(QWidget* parent = nullptr);

  void display(const TouchSession& session);
  /// The estimate of the discretisation error as text; empty: not estimated.
  void setErrorWords(const QString& words) { errorWords_ = words; }
  /// Displacement, pressure and stress at a mesh node; -1: none.
  void displayProbe(const TouchSession& session, int node, const ReferencePath* kept);
  /// The largest difference of the shown quantity from that of the reference design, or why it is unknown; nothing
  /// where it is not shown.
  void displayDifference(const Project& project, const TouchSession& session, const ReferencePath* kept,
                         const QString& problem);

signals:
  void estimateRequested();
  /// The touch is to be compared with the same force uniform, or not any more.
  void uniformRequested(bool on);

private:
  QLabel* result_ = nullptr;
  QPushButton* estimate_ = nullptr;
  QPushButton* uniform_ = nullptr;
  QLabel* probe_ = nullptr;
  QLabel* difference_ = nullptr;
  QString errorWords_;
};

} // namespace palp
