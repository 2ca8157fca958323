#pragma once

#include <QTimer>
#include <QWidget>

class QCheckBox;
class QLabel;
class QSlider;
class QToolButton;

namespace palp {

class TouchSession;

/// The way from rest to the full load: scrubbed, played once or in a loop. Its timer runs only while it plays.
class LoadPathBar : public QWidget {
public:
  explicit LoadPathBar(TouchSession& session, QWidget* parent = nullptr);

  void display();

protected:
  void hideEvent(QHideEvent* event) override;

private:
  void play(bool on);
  void step();
  void showPlace(int percent);

  TouchSession& session_;
  QToolButton* play_ = nullptr;
  QCheckBox* loop_ = nullptr;
  QSlider* slider_ = nullptr;
  QLabel* words_ = nullptr;
  QTimer timer_;
};

} // namespace palp
