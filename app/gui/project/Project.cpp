#include "app/gui/project/Project.h"

namespace palp {

TrainOptions NetworkSettings::trainOptions() const {
  TrainOptions options;
  options.input = input;
  options.mode = mode;
  options.decoder = decoder;
  options.target = target;
  options.rows = rows;
  options.noise = noise;
  if (centers > 0) options.centers = centers;
  if (!automaticSpread) options.spread = spread;
  options.allCenters = allCenters;
  options.centerChoice = centerChoice;
  options.solver = solver;
  options.ridge = ridge;
  options.scaling = scaling;
  options.tail = tail;
  options.convention = convention;
  options.forgetting = forgetting;
  options.seed = seed;
  return options;
}

bool NetworkSettings::trainOptionsSet() const {
  return centerChoice || allCenters || solver || ridge || scaling || tail || convention || forgetting != 1 || seed != 1;
}

Project exampleProject() {
  Project project;
  project.load.areas.push_back({1, {0.5, 0.3, -6}});
  return project;
}

} // namespace palp
