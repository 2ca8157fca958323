#pragma once

#include "app/gui/design/RestFloor.h"
#include "app/gui/jobs/NetworkSession.h"
#include "app/gui/project/Workbench.h"

#include <QGroupBox>

class QDoubleSpinBox;
class QLabel;
class QPushButton;

namespace palp {

/// The smallest errors that any decoder can reach on the project's design: by Eq. (1) from its samples, under the field
/// at rest, for every read-out and Eq. (1) side by side. Nothing is computed while it is not seen.
class NoiseFloor : public QGroupBox {
public:
  NoiseFloor(Workbench& workbench, NetworkSession& network, QWidget* parent = nullptr);

  /// Brings the words up to date with the project.
  void display();
  [[nodiscard]] JobRunner& runner() { return bounding_; }

protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

private:
  void displayPairs();
  void displayField();
  void boundPairs(double noise);
  void boundField(double noise);
  void forget();

  Workbench& workbench_;
  NetworkSession& network_;
  QDoubleSpinBox* noise_ = nullptr;
  QLabel* words_ = nullptr;
  QPushButton* samples_ = nullptr;
  std::optional<double> boundedFor_; ///< by Eq. (1): noise of the bound that is shown, or being computed
  std::optional<RestFloor> asked_;   ///< under the field: design and mesh of what is shown, or being computed
  double askedNoise_ = 0;
  std::shared_ptr<const RestFloor> floor_; ///< of the bounds
  std::optional<RestBounds> bounds_;       ///< that are shown
  JobRunner bounding_;
};

} // namespace palp
