#pragma once

#include "app/gui/touch/loads/AreaPlan.h"

#include <array>

class QComboBox;
class QDoubleSpinBox;
class QGridLayout;
class QLabel;
class QPushButton;
class QSlider;

namespace palp {

class IndenterPanel;

/// The forces on load areas and on discs, and the indenters: chosen on a plan of the top face or from a list, set by
/// numbers or sliders.
class LoadPanel : public QWidget {
  Q_OBJECT

public:
  explicit LoadPanel(QWidget* parent = nullptr);

  /// Emits nothing.
  void display(const SensorDesign& design, const LoadCase& load);
  /// Chooses a load as a click on the plan does; an area that bears none gets one.
  void choose(const LoadPlace& place);
  /// A new disc about a place of the top face.
  void addDisc(const Eigen::Vector2d& centre_mm);
  /// Another place and size of a disc, kept inside the face.
  void changeDisc(int disc, const Eigen::Vector2d& centre_mm, double radius_mm);
  /// A new indenter at a place of the top face: a sphere, or as the one that was edited last.
  void addIndenter(const Eigen::Vector2d& place_mm);
  /// Another place and size of an indenter.
  void moveIndenter(int indenter, const Eigen::Vector2d& place_mm);
  void sizeIndenter(int indenter, double radius_mm);
  void takeAway(const LoadPlace& place);
  /// A click on the top face: a new disc or indenter, or the one there is removed (Shift was held: else it
  /// would have been dragged).
  void pressDisc(const Eigen::Vector2d& place_mm);
  void pressIndenter(const Eigen::Vector2d& place_mm);

signals:
  /// By the user's hand only.
  void edited(const QString& what, const palp::LoadCase& load);

private:
  void buildChoice();
  void buildDisc();
  void buildForces();
  void showLoad();
  void showForce();
  void setForce(int direction, double value_N);
  void readDisc();
  void setIndenter(int indenter, const Indenter& to);
  [[nodiscard]] Indenter* chosenIndenter();
  [[nodiscard]] Eigen::Vector3d* forceOf(const LoadPlace& place);
  [[nodiscard]] bool bears(const LoadPlace& place) const;
  void chooseWhatIsThere();
  [[nodiscard]] QString name(const LoadPlace& place) const;
  [[nodiscard]] std::vector<LoadPlace> places() const;
  [[nodiscard]] Eigen::Vector3d firstPush_N() const;

  SensorDesign design_;
  LoadCase load_;
  LoadPlace chosen_;
  AreaPlan* plan_ = nullptr;
  QLabel* together_ = nullptr; ///< all loads as text
  QComboBox* list_ = nullptr;
  QLabel* title_ = nullptr;
  QPushButton* clear_ = nullptr;
  QWidget* disc_ = nullptr;
  QWidget* forces_ = nullptr;
  IndenterPanel* indenter_ = nullptr;
  QLabel* problem_ = nullptr;
  Indenter last_;                              ///< that was edited: the next one is like it
  std::array<QDoubleSpinBox*, 3> discSpins_{}; ///< x, y, radius
  std::array<QDoubleSpinBox*, 3> spins_{};
  std::array<QSlider*, 3> sliders_{};
};

} // namespace palp
