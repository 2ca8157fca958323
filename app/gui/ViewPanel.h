#pragma once

#include "app/scenes/DeformationScene.h"

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

  /// The chosen quantity, warp, clip and parts; all else as in `base`.
  [[nodiscard]] DeformationOptions options(const DeformationOptions& base) const;
  /// The factor that was drawn, shown while it is automatic.
  void displayWarp(double factor);
  void displayBlock(const Eigen::Vector3d& block_mm);

signals:
  void edited();

private:
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
