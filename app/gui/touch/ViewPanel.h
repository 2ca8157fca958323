#pragma once

#include "app/gui/project/ViewSettings.h"

#include <QWidget>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;

namespace palp {

/// How the block is drawn: colour, warp, clip and what is shown with it.
class ViewPanel : public QWidget {
  Q_OBJECT

public:
  explicit ViewPanel(QWidget* parent = nullptr);

  /// Emits nothing.
  void display(const ViewSettings& view, const Eigen::Vector3d& block_mm);
  /// The factor that was drawn, shown while it is automatic.
  void displayWarp(double factor);

signals:
  /// By the user's hand only.
  void edited(const palp::ViewSettings& view);

private:
  void read();

  ViewSettings view_;
  bool displaying_ = false;
  QComboBox* quantity_ = nullptr;
  QCheckBox* automaticWarp_ = nullptr;
  QDoubleSpinBox* warp_ = nullptr;
  QCheckBox* clip_ = nullptr;
  QDoubleSpinBox* clipY_ = nullptr;
  QCheckBox* ghost_ = nullptr;
  QCheckBox* electrodes_ = nullptr;
  QCheckBox* arrows_ = nullptr;
  QCheckBox* outlines_ = nullptr;
  QCheckBox* edges_ = nullptr;
};

} // namespace palp
