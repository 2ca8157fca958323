#include "app/study/paper/PublishedNumbers.h"

#include <cassert>
#include <sstream>

namespace palp {

extern const char* const kPublishedCsv; // made by CMake from resources/published.csv
extern const char* const kConvergedCsv; // made by CMake from resources/converged.csv

std::vector<PublishedPoint> publishedPoints(const std::string& figure) {
  std::vector<PublishedPoint> points;
  std::istringstream lines(kPublishedCsv);
  std::string line;
  std::getline(lines, line); // the heads
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::string name;
    std::string input;
    std::getline(cells, name, ',');
    std::getline(cells, input, ',');
    if (name != figure) continue;
    PublishedPoint point;
    char comma = 0;
    point.figure = name;
    cells >> point.spread;
    for (double& error : point.error_percent) cells >> comma >> error;
    assert(cells && "resources/published.csv has seven columns");
    points.push_back(point);
  }
  return points;
}

std::vector<PublishedSolution> publishedSolutions() {
  constexpr Eigen::Index kElectrodes = 10;
  std::vector<PublishedSolution> solutions;
  std::istringstream lines(kConvergedCsv);
  std::string line;
  std::getline(lines, line); // the heads
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    PublishedSolution solution;
    char comma = 0;
    std::getline(cells, solution.name, ',');
    cells >> solution.area;
    for (double& force : solution.force_N) cells >> comma >> force;
    cells >> comma >> solution.unknowns >> comma >> solution.statedError;
    solution.displacements_mm.resize(3, kElectrodes);
    for (double& u : solution.displacements_mm.reshaped()) cells >> comma >> u;
    assert(cells && "resources/converged.csv has 37 columns");
    solutions.push_back(std::move(solution));
  }
  return solutions;
}

} // namespace palp
