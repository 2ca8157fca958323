#pragma once

#include "app/gui/jobs/JobRunner.h"
#include "app/gui/jobs/LoadPath.h"
#include "app/study/touch/Touch.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace palp {

/// Another answer to compare the touch with that is shown: of the design that was kept to its load, or of its own
/// design to the same forces, uniform. The points of the two blocks that are compared are those at the same shares of
/// the blocks' sides: the same places where the blocks are of one size.
struct ReferencePath {
  SensorDesign design;
  LoadCase load; ///< as it acts on it: matchedLoad()
  /// The equilibria on its load path, their fields at the nodes of the shown touch's mesh.
  std::vector<LoadPathState> states;
  std::optional<Touch> touch; ///< under the law of the field, for the resistances

  /// Uniform forces grow in proportion, those of an indenter that is moved do not: load fractions of the touch that is
  /// shown, and those at which the uniform load is as large; empty: the same.
  std::vector<std::array<double, 2>> asLarge{};

  [[nodiscard]] double fractionAt(double shown) const;
  [[nodiscard]] LoadPathState at(double shown) const { return stateAt(states, fractionAt(shown)); }
};

/// The forces of the touch's indenters at the end of its load, uniform on the load areas beneath them; areas and discs
/// as they are. Throws Error where it follows a path: areas do not move.
LoadCase uniformLoad(const Touch& touch);

/// Solves the reference design under the touch's load, at the same shares of the block, and reads its fields at the
/// nodes of the touch's mesh. Throws Cancelled where it is stopped, Error where the reference design cannot bear the
/// load.
ReferencePath referencePath(const SensorDesign& kept, const Touch& shown, const std::stop_token& stop,
                            bool uniform = false);

/// The same in the background, and only while a scene shows it.
class ReferenceTouch : public QObject {
  Q_OBJECT

public:
  explicit ReferenceTouch(QObject* parent = nullptr);

  /// A scene compares this design with this touch: computed unless that was done, or runs.
  void want(const SensorDesign& kept, const Touch& shown, bool uniform);
  /// Null before it is there, and where another one was wanted last.
  [[nodiscard]] std::shared_ptr<const ReferencePath> pathFor(const SensorDesign& kept, const Touch& shown,
                                                             bool uniform) const;
  /// Why there is none, as text; empty while it is computed.
  [[nodiscard]] const QString& problem() const { return problem_; }
  /// Computes it again after a cancel.
  void resume();
  /// Nothing is kept any more.
  void forget();
  [[nodiscard]] JobRunner& runner() { return runner_; }

signals:
  void changed();

private:
  /// What it is computed of; the touch shares its results.
  struct Inputs {
    SensorDesign kept;
    Touch shown;
    bool uniform = false;
  };

  [[nodiscard]] bool wanted(const SensorDesign& kept, const Touch& shown, bool uniform) const;
  void run();

  JobRunner runner_;
  std::optional<Inputs> wanted_;
  std::shared_ptr<const ReferencePath> path_;
  QString problem_;
};

} // namespace palp
