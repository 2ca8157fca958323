#include "app/gui/project/Command.h"

#include "app/study/live/LiveSource.h"
#include "app/study/paper/PaperProtocol.h"
#include "model/base/Text.h"

namespace palp {

namespace {

QString vectorText(const Eigen::Vector3d& values) {
  return QString::fromStdString(text(values.x()) + "," + text(values.y()) + "," + text(values.z()));
}

QString trainOptions(const NetworkSettings& network) {
  TrainOptions options = network.trainOptions();
  options.spread.reset(); // an option of its own: a sweep has many
  return QString::fromStdString(asCommand(options));
}

} // namespace

QString meshOption(const MeshOptions& mesh) {
  if (mesh.meshSize_mm) return " --mesh-size " + QString::fromStdString(text(*mesh.meshSize_mm));
  if (mesh.mapped)
    return QString(" --mapped %1x%2x%3").arg((*mesh.mapped)[0]).arg((*mesh.mapped)[1]).arg((*mesh.mapped)[2]);
  return {};
}

QString meshCommands(const Project& project, const QString& designFile) {
  return "palp design --check " + designFile + "\npalp mesh " + designFile + meshOption(project.mesh) + " -o mesh.vtu";
}

QString solveCommands(const Project& project, const QString& designFile) {
  if (!loadsAfter(project.load, project.path, project.design).empty()) // path.json: "Save as a load file" of its panel
    return "palp solve " + designFile + " --loads path.json" + meshOption(project.mesh) + " -o deformed.vtu";
  QString command;
  for (const AreaLoad& load : project.load.areas)
    command += QString(" --load %1:%2").arg(load.area).arg(vectorText(load.force_N));
  for (const PatchLoad& patch : project.load.patches)
    command += QString::fromStdString(" --patch " + text(patch.centre_mm.x()) + "," + text(patch.centre_mm.y()) + "," +
                                      text(patch.radius_mm) + ":") +
               vectorText(patch.force_N);
  for (const Indenter& indenter : project.load.indenters) command += " " + QString::fromStdString(asCommand(indenter));
  command += meshOption(project.mesh);
  const QString quantity = QString::fromStdString(quantityName(project.view.quantity));
  return "palp solve " + designFile + command + " -o deformed.vtu\npalp render " + designFile + command +
         " --quantity \"" + quantity + "\" -o deformed.png";
}

QString sampleCommands(const Project& project, const QString& designFile) {
  const SampleSettings& samples = project.samples;
  const QString what = samples.touches
                           ? QString::fromStdString(asCommand(rangeOf(*samples.touches, project.design))) +
                                 QString(" --count %1").arg(samples.touches->count)
                           : QString(" --per-area %1").arg(samples.perArea) + (samples.surrogate ? " --surrogate" : "");
  const auto sample = [&](std::uint64_t seed, const QString& file) {
    return "palp sample " + designFile + what + QString(" --seed %1").arg(seed) + meshOption(project.mesh) + " -o " +
           file;
  };
  return sample(samples.seed, "train.csv") + "\n" + sample(testSeed(samples.seed), "test.csv");
}

QString predictCommand(const NetworkSettings& network, const QString& file) {
  const QString command = "palp predict " + file + " test.csv --bare";
  if (network.testNoise <= 0) return command;
  return command + QString::fromStdString(" --noise " + text(network.testNoise)) +
         QString(" --seed %1").arg(testSeed(network.seed));
}

QString trainCommands(const NetworkSettings& network, const QString& designFile, const QString& file) {
  const QString spread = network.automaticSpread ? "auto" : QString::fromStdString(text(network.chosenSpread));
  const QString design = traits(network.decoder).usesDesign ? " --design " + designFile : QString();
  return "palp train train.csv" + trainOptions(network) + " --spread " + spread + design + " -o " + file + "\n" +
         predictCommand(network, file);
}

QString sweepCommand(const NetworkSettings& network) {
  return "palp sweep train.csv --test test.csv" + trainOptions(network) +
         QString::fromStdString((network.testNoise > 0 ? " --test-noise " + text(network.testNoise) : std::string()) +
                                " --spreads " + text(network.sweepFrom) + ":" + text(network.sweepTo) + ":") +
         QString::number(network.sweepCount);
}

QString networkCommands(const Project& project, const QString& designFile) {
  const bool rbf = project.network.decoder == DecoderKind::Rbf; // the others have no spread to sweep
  return sampleCommands(project, designFile) + "\n" + trainCommands(project.network, designFile, "network.json") +
         (rbf ? "\n" + sweepCommand(project.network) : QString());
}

QString liveCommand(const LiveSettings& live) {
  const auto option = [](const std::string& name, const std::string& value) {
    return QString::fromStdString(" --" + name + " '" + value + "'");
  };
  const SimulationSettings& simulation = live.simulation;
  QString command = "palp listen";
  switch (live.source) {
  case LiveSourceKind::Automatic:
  case LiveSourceKind::Simulated:
    command +=
        " --simulate --rate " + QString::number(live.rate_Hz) +
        QString::fromStdString(" --noise " + text(simulation.noise) + " --warming " + text(simulation.warming_degC) +
                               " --hysteresis " + text(simulation.hysteresisShare)) +
        " --seed " + QString::number(simulation.seed);
    if (simulation.openRow >= 0) command += " --open-row " + QString::number(simulation.openRow);
    if (simulation.openColumn >= 0) command += " --open-column " + QString::number(simulation.openColumn);
    if (simulation.dropEvery > 0) command += " --drop-every " + QString::number(simulation.dropEvery);
    break;
  case LiveSourceKind::Board:
    command += option("device", live.device);
    break;
  case LiveSourceKind::Recording:
    command += option("replay", live.recording) + QString::fromStdString(" --speed " + text(live.replaySpeed));
    break;
  }
  if (live.row >= 0) command += " --row " + QString::number(live.row);
  const bool simulated = live.source == LiveSourceKind::Automatic || live.source == LiveSourceKind::Simulated;
  const std::string network = live.network.empty() && !simulated ? shippedNetwork().string() : live.network;
  if (!network.empty()) command += option("network", network);
  for (const LiveReceiver& receiver : live.receivers)
    if (receiver.on) command += option("send", receiver.to);
  if (live.source == LiveSourceKind::Recording) return command; // its tare is in it
  return command + " --tare " + QString::number(live.tareFrames);
}

} // namespace palp
