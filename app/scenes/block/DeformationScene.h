#pragma once

#include "app/scenes/ColorScale.h"
#include "app/scenes/block/QuantityValues.h"
#include "app/scenes/block/current/CurrentLines.h"
#include "app/scenes/block/loads/ForceArrows.h"
#include "model/LoadCase.h"
#include "model/Mesh.h"
#include "model/RowColumnResistance.h"
#include "model/SensorDesign.h"
#include "model/Solution.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkRenderer;

namespace palp {

struct FaceMap;
struct PlacedText;

/// A plane across the block at rest: what lies before it, as the block is seen first, is cut away.
struct CutPlane {
  int axis = 1; ///< 0, 1, 2: across x, y, z
  double at_mm = 0;

  /// Points to what stays.
  [[nodiscard]] Eigen::Vector3d normal() const { return (axis == 2 ? -1 : 1) * Eigen::Vector3d::Unit(axis); }
  [[nodiscard]] bool keeps(const Eigen::Vector3d& place_mm) const {
    return axis == 2 ? place_mm.z() <= at_mm : place_mm[axis] >= at_mm;
  }
  /// Where it is taken by the mouse.
  [[nodiscard]] Eigen::Vector3d grip_mm(const Eigen::Vector3d& block_mm) const;
  bool operator==(const CutPlane&) const = default;
};

/// What is drawn, and how.
struct DeformationOptions {
  Quantity quantity = Quantity::Displacement;
  std::optional<double>
      deformationScale; ///< of the drawn displacements; none: automatic, 1, 2 or 5 times a power of ten
  bool undeformedGhost = true;
  bool electrodes = true;
  bool forceArrows = true;
  bool areaOutlines = true;
  bool meshEdges = true;
  double opacity = 0.82; ///< of the coloured surface, while the electrodes show through it
  std::optional<CutPlane> cut;
  bool cutGrip = false;                                  ///< draws where the cut is taken by the mouse
  bool lessReference = false;                            ///< colours by the difference to another answer
  bool lessUniform = false;                              ///< that is the touch's own design, its forces uniform
  bool extremes = false;                                 ///< marks the largest and the smallest value
  std::optional<ColorMap> colorMap;                      ///< none: as the quantity asks for
  std::optional<std::array<double, 2>> fixedRange;       ///< of the colours; else the values' own
  std::optional<std::array<Eigen::Vector3d, 2>> line_mm; ///< ends at rest of a line that is drawn with the block
  Eigen::Matrix2Xd way_mm;                               ///< that an indenter takes over the top face; empty: none
  std::vector<int> selectedAreas;                        ///< outlined more strongly
  std::optional<std::array<int, 2>> litCell;             ///< row-wire, column-wire whose electrodes light up
  Theme theme = Theme::Light;
  double scale = 1;      ///< of text and lines
  bool fullLoad = false; ///< shows "100 % of the load" too, as in a film
};

/// The load step to draw: what it was computed from and what came out. All but design and mesh may be null (at rest).
struct DeformationState {
  const SensorDesign* design = nullptr;
  const Mesh* mesh = nullptr;
  const NodalFields* fields = nullptr;
  const ElectrodeDisplacements* electrodes = nullptr;
  const LoadCase* load = nullptr;
  double loadFraction = 1;
  std::vector<IndenterState> indenters{}; ///< what the load's indenters do; empty at rest
  // For the difference from a reference design; null until that is available.
  const SensorDesign* referenceDesign = nullptr;
  const LoadCase* keptLoad = nullptr;
  const NodalFields* kept = nullptr; ///< its fields at the nodes of `mesh`
  /// The current paths in this state: drawn in a block without colours.
  const CurrentLines* current = nullptr;
  /// Of the block at rest: drawn over its top face.
  const FaceMap* map = nullptr;
};

/// The range of the colours over these values, as the options choose quantity and map.
std::array<double, 2> quantityRange(const DeformationOptions& options, const std::vector<double>& values);

/// The largest 1, 2 or 5 times a power of ten that keeps the drawn displacements under a fifth of the block's thinnest
/// side; at least 1.
double automaticDeformationScale(const SensorDesign& design, const Eigen::Matrix3Xd& displacement_mm);

/// From the front, above and the left.
const Eigen::Vector3d kFirstLook(0.45, 1.0, -0.75);

/// The deformed block in a renderer that the caller puts into a window.
class DeformationScene {
public:
  DeformationScene();
  ~DeformationScene();

  [[nodiscard]] vtkRenderer* renderer() const;
  /// Draws the state; the mesh's surface is found again only where `meshChanged`.
  void show(const DeformationState& state, const DeformationOptions& options, bool meshChanged);
  /// Looks at the complete block from the front, above and the left, in a view `aspect` times as wide as high.
  void resetCamera(const SensorDesign& design, double aspect);
  /// Looks at it along a direction; the legend takes this share of the width.
  void resetCamera(const SensorDesign& design, double aspect, const Eigen::Vector3d& direction,
                   std::optional<double> legendShare = {});

  /// What the legend that is drawn, or will be, needs at the right side of the view [px].
  [[nodiscard]] double legendRoom_px() const;

  /// Of words and legend alone, from now on; show() sets it to the scale of its options.
  void setTextScale(double scale);
  [[nodiscard]] double deformationScale() const;
  [[nodiscard]] std::array<double, 2> colorRange() const; ///< as drawn last
  /// The mesh node drawn nearest to a point of the scene [mm, warped]; -1 without a mesh.
  [[nodiscard]] int nearestNode(const Eigen::Vector3d& drawn_mm) const;
  /// Marks a mesh node; -1 marks none.
  void markNode(int node);

  /// The balls without text in the picture: what each marks, with its position.
  [[nodiscard]] std::vector<PlacedText> tips() const;

  /// The arrows as drawn, and their scale.
  [[nodiscard]] const std::vector<PlacedForce>& forces() const;
  [[nodiscard]] double arrowScale_mmPerN() const;
  /// The loaded discs as drawn.
  [[nodiscard]] const std::vector<PatchLoad>& discs() const;
  /// Draws a disc and its arrow at another place, while it is dragged; all else stays.
  void moveDisc(std::size_t disc, const PatchLoad& to);
  /// The indenters as drawn, and the same for them.
  [[nodiscard]] const std::vector<Indenter>& indenters() const;
  void moveIndenter(std::size_t indenter, const Indenter& to);
  /// Another way over the top face, while it is drawn by the mouse.
  void showWay(const Eigen::Matrix2Xd& way_mm);
  /// Where the material lies at rest that is drawn at a point of a triangle of the surface.
  [[nodiscard]] Eigen::Vector3d restPlace_mm(long long triangle, const Eigen::Vector3d& drawn_mm) const;

  /// Draws one arrow for another force, while it is dragged; all else stays.
  void moveForce(std::size_t arrow, const Eigen::Vector3d& force_N);

private:
  struct Parts;
  void moveArrow(std::size_t arrow, const Eigen::Vector2d& top_mm);
  std::unique_ptr<Parts> parts_;
};

} // namespace palp
