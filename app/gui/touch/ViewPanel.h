#pragma once

#include "app/gui/project/ViewSettings.h"
#include "app/gui/widgets/FieldBindings.h"

#include <QWidget>

#include <array>

class QFormLayout;

namespace palp {

/// How the block is drawn: colour and legend, deformation scale, cut and what is shown with it.
class ViewPanel : public QWidget {
  Q_OBJECT

public:
  explicit ViewPanel(QWidget* parent = nullptr);

  /// Emits nothing.
  void display(const ViewSettings& view, const Eigen::Vector3d& block_mm, bool somethingKept, bool pressed);
  /// The factor and the range of the colours that were drawn, shown while they are automatic.
  void displayDrawn(double deformationScale, const std::array<double, 2>& range);

signals:
  /// By the user's hand only.
  void edited(const palp::ViewSettings& view);

private:
  void buildColors(QFormLayout& form);
  void buildScale(QFormLayout& form);
  void buildCut(QFormLayout& form);
  void read();
  void readInto(ViewSettings& view) const;
  void chooseQuantity();
  void chooseKept();

  FieldBindings<ViewSettings> fields_;
  Eigen::Vector3d block_mm_ = paperDesign().block_mm;
  bool displaying_ = false;
  QComboBox* quantity_ = nullptr;
  QComboBox* colorMap_ = nullptr;
  QCheckBox* keepRange_ = nullptr;
  QCheckBox* lessReference_ = nullptr;
  std::array<QDoubleSpinBox*, 2> range_{};
  QCheckBox* automaticScale_ = nullptr;
  QDoubleSpinBox* warp_ = nullptr;
  QComboBox* cut_ = nullptr;
  QDoubleSpinBox* cutAt_ = nullptr;
};

} // namespace palp
