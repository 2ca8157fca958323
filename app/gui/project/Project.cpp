#include "app/gui/project/Project.h"

#include "app/study/decoding/TrainOptionTable.h"

#include <algorithm>

namespace palp {

TrainOptions NetworkSettings::trainOptions() const {
  TrainOptions options = *this;
  options.spread = automaticSpread ? std::nullopt : std::optional(chosenSpread);
  return options;
}

bool NetworkSettings::trainOptionsSet() const {
  return allCenters || std::any_of(trainOptionTable().begin(), trainOptionTable().end(),
                                   [this](const TrainOption& one) { return one.inForm && one.isSet(*this); });
}

void setDesign(Project& project, const SensorDesign& design) {
  const LoadCase before = project.load;
  project.design = design;
  std::erase_if(project.load.areas, [&](const AreaLoad& load) { return load.area >= design.areas.count(); });
  std::erase_if(project.load.patches, [&](const PatchLoad& disc) { return whyInvalid({{}, {disc}}, design); });
  std::erase_if(project.load.indenters, [&](const Indenter& its) { return whyInvalid(its, design); });
  project.path = pathKept(project.path, before, project.load);
}

Project exampleProject() {
  Project project;
  project.load.areas.push_back({1, {0.5, 0.3, -6}});
  return project;
}

} // namespace palp
