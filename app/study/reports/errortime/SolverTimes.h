#pragma once

#include "app/study/paper/PublishedNumbers.h"
#include "app/study/reports/Report.h"
#include "app/study/reports/Timing.h"
#include "model/LoadCase.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace palp {

/// A load that meshes are judged by, and what the upper electrodes do under it.
struct JudgedLoad {
  std::string name;
  LoadCase load;
  Eigen::Matrix3Xd reference_mm; ///< extrapolated from three meshes of tetrahedra; empty: too few have an answer
  double uncertainty = 0;        ///< relative: extrapolated against the finest
  double order = 0;              ///< observed, of the error in the mesh size
};

/// One mesh: its sizes, the seconds of each phase, and the error of each load.
struct MeshTimes {
  std::string family; ///< tetrahedra, hexahedra
  std::string mesh;
  MeshOptions options;
  double size_mm = 0; ///< mean horizontal size
  int dof = 0;
  int elements = 0;
  double factor_MB = 0;  ///< memory of the Cholesky factor
  double process_MB = 0; ///< most that the process held during the first run, above what it held before
  Timing meshing, pattern, factorisation, solving;
  std::vector<double> loadSeconds;     ///< median of the nonlinear solve, a load
  std::vector<double> errors;          ///< relative L2 of the upper electrodes' displacements, a load
  std::vector<double> publishedErrors; ///< the same of row-wire 4 against another program's solutions
  std::string failed;                  ///< why there are no numbers; empty where there are

  /// Medians of all phases to the first answer.
  [[nodiscard]] double total_s() const;
};

struct SolverTimes {
  std::vector<JudgedLoad> loads;
  std::vector<MeshTimes> meshes;
  std::vector<PublishedSolution> published; ///< empty where the design is not the paper's
  std::string deck; ///< of CalculiX, for the paper's mapped mesh and the first load; empty: not installed
};

/// Every mesh under every load, `repeats` times. Empty where it was stopped.
std::optional<SolverTimes> solverTimes(const SensorDesign& design, bool quick, int repeats, int threads,
                                       const ReportProgress& progress, std::stop_token stop);

} // namespace palp
