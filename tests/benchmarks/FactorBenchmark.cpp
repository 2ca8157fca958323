// Our multifrontal factorisation beside CHOLMOD's supernodal one on the same matrices: tangents at rest of the paper's
// block. Prints a Markdown table.
//   factor_benchmark [ROUNDS]              every matrix, method and number of threads; medians of the rounds (default
//   5) factor_benchmark MATRIX METHOD THREADS one measurement, as a line of numbers
// Each measurement is a process of its own, so that none finds the other's memory warm; a round takes the methods in
// turn, so that a machine that changes its speed changes it for all. CHOLMOD runs on as many threads of OpenBLAS as
// ours has of its own, once in our order of the unknowns and once in the order it finds itself (AMD, then METIS).
#include "solver/SensorMesh.h"
#include "solver/linear/Front.h"
#include "solver/statics/LinearisedBlock.h"

#include <cblas.h>
#include <cholmod.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <limits>
#include <malloc.h>
#include <stdexcept>
#include <string>
#include <vector>

using namespace palp;

namespace {

const std::vector<std::string> matrices{"default", "fine", "thin", "incompressible"};
const std::vector<std::string> methods{"ours", "CHOLMOD, our order", "CHOLMOD, its order"};

/// The tangent at rest of one of `matrices`, lower triangle.
struct Tangent {
  std::shared_ptr<const SparsePattern> pattern;
  LaneVector values;

  explicit Tangent(const std::string& matrix) {
    SensorDesign design = paperDesign();
    if (matrix == "thin") {
      design.block_mm.z() = 1;
      design.upper.z_mm = {{0.8}};
      design.lower.z_mm = {{0.2}};
    }
    if (matrix == "incompressible") design.material.poissonRatio = 0.5;
    MeshOptions options;
    if (matrix == "fine") options.meshSize_mm = 0.6 * standardMeshSize_mm(design);
    const HyperelasticProblem problem(design, sensorMesh(design, options));
    const Assembler& assembler = problem.block().assembler;
    ElementTangents tangents;
    ElementForces forces;
    assembler.tangent(problem.block().discretisation->atRest(), tangents, forces, 2, {});
    pattern = assembler.pattern();
    values = assembler.matrix(tangents, 2);
  }

  [[nodiscard]] Eigen::VectorXd times(const Eigen::VectorXd& x) const {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(x.size());
    for (int j = 0; j < pattern->size(); ++j)
      for (int k = pattern->columns[j]; k < pattern->columns[j + 1]; ++k) {
        y(pattern->rows[k]) += values[k] * x(j);
        if (pattern->rows[k] != j) y(j) += values[k] * x(pattern->rows[k]);
      }
    return y;
  }

  [[nodiscard]] cholmod_sparse cholmod() const {
    cholmod_sparse A{};
    A.nrow = A.ncol = pattern->size();
    A.nzmax = pattern->rows.size();
    A.p = const_cast<int*>(pattern->columns.data()); // read only
    A.i = const_cast<int*>(pattern->rows.data());
    A.x = const_cast<double*>(values.data());
    A.stype = -1;
    A.itype = CHOLMOD_INT;
    A.xtype = CHOLMOD_REAL;
    A.dtype = CHOLMOD_DOUBLE;
    A.sorted = A.packed = 1;
    return A;
  }
};

double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A line of /proc/self/status [MB].
double memory_MB(const std::string& line) {
  std::ifstream file("/proc/self/status");
  std::string word;
  double kB = 0;
  while (file >> word)
    if (word == line + ":" && file >> kB) return kB / 1024;
  return std::numeric_limits<double>::quiet_NaN();
}

/// The peak counts from here on; returns what is resident now [MB].
double restartPeak_MB() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
  return memory_MB("VmRSS");
}

struct Figures {
  double unknowns = 0, analysis_s = 0, wall_s = 0, cpu_s = 0, peak_MB = 0, kept_MB = 0, solve_s = 0, residual = 0;
  double bytes = 0; ///< 48 bits of a hash of the solution's bytes
};

double hash(const Eigen::VectorXd& x) {
  std::uint64_t h = 14695981039346656037U; // FNV-1a
  const auto* bytes = reinterpret_cast<const unsigned char*>(x.data());
  for (std::size_t i = 0; i < x.size() * sizeof(double); ++i) h = (h ^ bytes[i]) * 1099511628211U;
  return static_cast<double>(h >> 16U);
}

/// Times one factorisation and one solution. `factorise` and `solve` of the method; `prepare` is not timed.
template <class Factorise, class Solve>
void measure(const Tangent& tangent, Figures& figures, const Factorise& factorise, const Solve& solve) {
  const double before_MB = restartPeak_MB(), start_s = wall_s();
  const std::clock_t cpu = std::clock();
  factorise();
  figures.wall_s = wall_s() - start_s;
  figures.cpu_s = double(std::clock() - cpu) / CLOCKS_PER_SEC;
  figures.peak_MB = memory_MB("VmHWM") - before_MB;
  malloc_trim(0);
  figures.kept_MB = memory_MB("VmRSS") - before_MB;
  const Eigen::VectorXd b =
      Eigen::VectorXd::NullaryExpr(tangent.pattern->size(), [](Eigen::Index i) { return std::sin(3. * double(i)); });
  const double solveStart_s = wall_s();
  const Eigen::VectorXd x = solve(b);
  figures.solve_s = wall_s() - solveStart_s;
  figures.residual = (b - tangent.times(x)).norm() / b.norm();
  figures.bytes = hash(x);
}

Figures ours(const Tangent& tangent, int threads) {
  Figures figures;
  const double start_s = wall_s();
  const auto plan = std::make_shared<const CholeskyPlan>(tangent.pattern);
  figures.analysis_s = wall_s() - start_s;
  LaneVector values = tangent.values;
  std::unique_ptr<SparseCholesky> cholesky;
  measure(
      tangent, figures,
      [&] {
        cholesky = std::make_unique<SparseCholesky>(plan);
        if (cholesky->factorise(std::move(values), threads, {}) != SparseCholesky::Outcome::Done)
          throw std::runtime_error("our factorisation failed");
      },
      [&](Eigen::VectorXd b) {
        cholesky->solve(b);
        return b;
      });
  return figures;
}

Figures cholmod(const Tangent& tangent, int threads, bool ourOrder) {
  openblas_set_num_threads(threads);
  cholmod_common common;
  cholmod_start(&common);
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.print = 0;
  cholmod_sparse A = tangent.cholmod();
  Figures figures;
  cholmod_factor* factor = nullptr;
  double start_s = wall_s();
  if (ourOrder) {
    std::vector<int> order = supernodeTree(*tangent.pattern).order;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.postorder = 1;
    start_s = wall_s();
    factor = cholmod_analyze_p(&A, order.data(), nullptr, 0, &common);
  } else {
    factor = cholmod_analyze(&A, &common);
  }
  figures.analysis_s = wall_s() - start_s;
  measure(
      tangent, figures,
      [&] {
        cholmod_factorize(&A, factor, &common);
        if (common.status != CHOLMOD_OK) throw std::runtime_error("CHOLMOD's factorisation failed");
      },
      [&](const Eigen::VectorXd& b) {
        cholmod_dense right{};
        right.nrow = right.nzmax = right.d = b.size();
        right.ncol = 1;
        right.x = const_cast<double*>(b.data());
        right.xtype = CHOLMOD_REAL;
        cholmod_dense* x = cholmod_solve(CHOLMOD_A, factor, &right, &common);
        const Eigen::VectorXd solution = Eigen::Map<Eigen::VectorXd>(static_cast<double*>(x->x), b.size());
        cholmod_free_dense(&x, &common);
        return solution;
      });
  cholmod_free_factor(&factor, &common);
  cholmod_finish(&common);
  return figures;
}

/// One measurement, printed for the process that asked.
void printOne(const std::string& matrix, const std::string& method, int threads) {
  const Tangent tangent(matrix);
  Figures f = method == methods[0] ? ours(tangent, threads) : cholmod(tangent, threads, method == methods[1]);
  f.unknowns = tangent.pattern->size();
  std::printf("%.0f %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.0f\n", f.unknowns, f.analysis_s, f.wall_s, f.cpu_s, f.peak_MB,
              f.kept_MB, f.solve_s, f.residual, f.bytes);
}

Figures measured(const std::string& program, const std::string& matrix, const std::string& method, int threads) {
  const std::string command = "'" + program + "' '" + matrix + "' '" + method + "' " + std::to_string(threads);
  std::FILE* pipe = popen(command.c_str(), "r");
  Figures f;
  const int read = pipe ? std::fscanf(pipe, "%lf %lf %lf %lf %lf %lf %lf %lf %lf", &f.unknowns, &f.analysis_s,
                                      &f.wall_s, &f.cpu_s, &f.peak_MB, &f.kept_MB, &f.solve_s, &f.residual, &f.bytes)
                        : 0;
  if (!pipe || pclose(pipe) != 0 || read != 9) throw std::runtime_error("no figures from " + command);
  return f;
}

double median(const std::vector<Figures>& rounds, double Figures::*figure) {
  std::vector<double> values;
  for (const Figures& f : rounds) values.push_back(f.*figure);
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

void printTable(const std::string& program, int rounds) {
  std::printf("| matrix | unknowns | method | threads | analysis [s] | factor [s] | CPU [s] | peak [MB] | kept [MB] | "
              "solve [ms] | residual | time / ours | peak / ours | bytes |\n"
              "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& matrix : matrices) {
    std::vector<std::vector<Figures>> all(2 * methods.size());
    for (int round = 0; round < rounds; ++round)
      for (std::size_t i = 0; i < all.size(); ++i)
        all[i].push_back(measured(program, matrix, methods[i / 2], 1 + static_cast<int>(i % 2)));
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::vector<Figures>& runs = all[i];
      const auto sameAs = [](const std::vector<Figures>& some, double bytes) {
        return std::all_of(some.begin(), some.end(), [&](const Figures& f) { return f.bytes == bytes; });
      };
      std::vector<Figures> ratios; // to ours of the same round
      for (int round = 0; round < rounds; ++round) {
        const Figures &f = runs[round], &our = all[i % 2][round];
        ratios.push_back({.wall_s = f.wall_s / our.wall_s, .peak_MB = f.peak_MB / our.peak_MB});
      }
      const char* bytes = !sameAs(runs, runs[0].bytes)         ? "vary"
                          : sameAs(all[i ^ 1U], runs[0].bytes) ? "the same on 1 and 2"
                                                               : "other on 1 and 2";
      std::printf("| %s | %.0f | %s | %zu | %.3f | %.3f | %.3f | %.1f | %.1f | %.1f | %.0e | %.2f | %.2f | %s |\n",
                  matrix.c_str(), runs[0].unknowns, methods[i / 2].c_str(), 1 + i % 2,
                  median(runs, &Figures::analysis_s), median(runs, &Figures::wall_s), median(runs, &Figures::cpu_s),
                  median(runs, &Figures::peak_MB), median(runs, &Figures::kept_MB),
                  1e3 * median(runs, &Figures::solve_s), median(runs, &Figures::residual),
                  median(ratios, &Figures::wall_s), median(ratios, &Figures::peak_MB), bytes);
    }
    std::fflush(stdout);
  }
}

} // namespace

int main(int argc, char** argv) {
  try {
    if (argc == 4)
      printOne(argv[1], argv[2], std::max(1, std::atoi(argv[3])));
    else
      printTable(argv[0], argc == 2 ? std::max(1, std::atoi(argv[1])) : 5);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "factor_benchmark: %s\n", error.what());
    return 1;
  }
  return 0;
}
