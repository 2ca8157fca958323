#include "app/gui/project/Project.h"

namespace palp {

TrainOptions NetworkSettings::trainOptions() const {
  TrainOptions options;
  options.input = input;
  options.mode = mode;
  options.decoder = decoder;
  options.rows = rows;
  options.noise = noise;
  if (centers > 0) options.centers = centers;
  if (!automaticSpread) options.spread = spread;
  return options;
}

Project exampleProject() {
  Project project;
  project.load.areas.push_back({1, {0.5, 0.3, -6}});
  return project;
}

} // namespace palp
