#include "app/gui/project/ResultCsv.h"

#include "app/gui/project/Command.h"
#include "app/gui/project/ExportLines.h"
#include "io/AtomicFile.h"
#include "model/base/Text.h"

namespace palp {

namespace {

QString exactNumber(double value) {
  return QString::fromStdString(text(value));
}

QString exactTriple(const Eigen::Vector3d& values) {
  return "(" + exactNumber(values.x()) + ", " + exactNumber(values.y()) + ", " + exactNumber(values.z()) + ")";
}

} // namespace

QString sourceLines(const ResultSource& source) {
  QString text = "# palp, share of the load " + exactNumber(source.loadFraction) + "\n";
  for (const AreaLoad& load : source.load.areas)
    text += QString("# load on area %1: ").arg(load.area) + exactTriple(load.force_N) + " N\n";
  for (const PatchLoad& disc : source.load.patches)
    text += "# load on a disc at (" + exactNumber(disc.centre_mm.x()) + ", " + exactNumber(disc.centre_mm.y()) +
            ") mm with radius " + exactNumber(disc.radius_mm) + " mm: " + exactTriple(disc.force_N) + " N\n";
  for (const Indenter& indenter : source.load.indenters)
    text += "# indenter, as an option of palp solve: " + QString::fromStdString(asCommand(indenter)) + "\n";
  const QString mesh = meshOption(source.mesh).trimmed();
  text += "# mesh " + (mesh.isEmpty() ? QString("default of palp") : mesh) + "\n";
  return text + exportLines({}, source.design, source.stale);
}

namespace {

/// Lines of one layer, wire by wire.
QString electrodeLines(const QString& layer, int perWire, const Eigen::Matrix3Xd& places_mm,
                       const Eigen::Matrix3Xd& displacements_mm) {
  QString text;
  for (Eigen::Index k = 0; k < places_mm.cols(); ++k) {
    text += QString("%1,%2,%3").arg(layer).arg(k / perWire).arg(k % perWire);
    for (const double value : places_mm.col(k)) text += "," + exactNumber(value);
    for (const double value : displacements_mm.col(k)) text += "," + exactNumber(value);
    text += "\n";
  }
  return text;
}

} // namespace

QString electrodesCsv(const ResultSource& source, const ElectrodeDisplacements& displacements) {
  const SensorDesign& design = source.design;
  const Eigen::Matrix3Xd upper = design.upperElectrodes_mm(), lower = design.lowerElectrodes_mm();
  const Eigen::Matrix3Xd still = Eigen::Matrix3Xd::Zero(3, lower.cols());
  const QString lowerWords = design.lowerFollowsRubber
                                 ? "they follow the rubber"
                                 : "they are fixed in the design (follows_rubber false), their displacements are 0";
  return sourceLines(source) +
         QString("# upper: %1 electrodes of the row-wires; lower: %2 of the column-wires, ")
             .arg(upper.cols())
             .arg(lower.cols()) +
         lowerWords + "\nlayer,wire,electrode,x_mm,y_mm,z_mm,u_x_mm,u_y_mm,u_z_mm\n" +
         electrodeLines("upper", design.electrodesPerRowWire(), upper, displacements.upper_mm) +
         electrodeLines("lower", design.electrodesPerColumnWire(), lower,
                        design.lowerFollowsRubber ? displacements.lower_mm : still);
}

QString resistancesCsv(const ResultSource& source, const TouchResistances& resistances) {
  QString text = sourceLines(source) + "row_wire,column_wire,R_at_rest_ohm,R_ohm\n";
  const auto& [rest, loaded] = resistances;
  for (Eigen::Index row = 0; row < rest.rows(); ++row)
    for (Eigen::Index column = 0; column < rest.cols(); ++column)
      text += QString("%1,%2,").arg(row).arg(column) + exactNumber(rest(row, column)) + "," +
              exactNumber(loaded(row, column)) + "\n";
  return text;
}

void writeText(const QString& file, const QString& text) {
  writeFile(file.toStdString(), text.toStdString(), true);
}

} // namespace palp
