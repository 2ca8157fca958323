#include "app/study/PublishedNumbers.h"

#include <cassert>
#include <sstream>

namespace palp {

extern const char* const kPublishedCsv; // made by CMake from resources/published.csv

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

} // namespace palp
