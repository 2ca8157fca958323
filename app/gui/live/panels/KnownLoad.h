#pragma once

#include "app/study/decoding/Calibration.h"

#include <QWidget>

#include <array>
#include <optional>

class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QHBoxLayout;
class QLabel;
class QPushButton;
class QSpinBox;

namespace palp {

/// Three masses [g] of a set of weights (1, 2, 5, 10, 20, 50 ...) to calibrate with, the heaviest first: the heaviest
/// one whose weight is within `most_N`, and the two below it. Zeros where even 1 g is too heavy.
std::array<double, 3> suggestedMasses_g(double most_N);

/// The load that is known to act on the sensor now: its area, or its place where the network gives one, and its force
/// in newtons, or as a mass that rests on the area or pulls it along x or y by a thread. Next to the force is what
/// the network reads.
class KnownLoad : public QWidget {
  Q_OBJECT

public:
  explicit KnownLoad(QWidget* parent = nullptr);

  /// The areas, or places, that may be pressed, and masses that suit the force range of the network; null: none.
  void setSensor(const SensorDesign& sensor, const Decoder* decoder);
  [[nodiscard]] KnownTouch load() const;
  /// The decoded force now [N]; none: nothing is decoded.
  void displayReading(const std::optional<Eigen::Vector3d>& force_N);

private:
  QHBoxLayout* buildPlace();
  QHBoxLayout* buildMass();
  QHBoxLayout* buildSuggestions();
  QLayout* buildForces();
  void takeMass();

  QFormLayout* form_ = nullptr;
  SensorDesign sensor_;
  QSpinBox* area_ = nullptr;
  QHBoxLayout* placeRow_ = nullptr;
  std::array<QDoubleSpinBox*, 2> place_mm_{};
  bool placed_ = false;              ///< the network gives places
  QDoubleSpinBox* mass_g_ = nullptr; ///< 0: the force was typed in newtons
  QComboBox* direction_ = nullptr;
  std::array<QPushButton*, 3> suggested_{};
  std::array<QDoubleSpinBox*, 3> force_N_{};
  std::array<QLabel*, 3> reads_{};
};

} // namespace palp
