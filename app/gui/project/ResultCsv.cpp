#include "app/gui/project/ResultCsv.h"

#include "model/base/Error.h"

#include <QSaveFile>

namespace palp {

namespace {

QString number(double value) {
  return QString::number(value, 'g', 17);
}

} // namespace

QString resultCsv(const SensorDesign& design, const ElectrodeDisplacements& displacements) {
  QString text = "row_wire,electrode,x_mm,y_mm,z_mm,u_x_mm,u_y_mm,u_z_mm\n";
  const Eigen::Matrix3Xd places = design.upperElectrodes_mm();
  const int perRow = design.electrodesPerRowWire();
  for (Eigen::Index k = 0; k < places.cols(); ++k) {
    text += QString("%1,%2").arg(k / perRow).arg(k % perRow);
    for (const double value : places.col(k)) text += "," + number(value);
    for (const double value : displacements.upper_mm.col(k)) text += "," + number(value);
    text += "\n";
  }
  text += "\nrow_wire,column_wire,R_at_rest_ohm,R_ohm\n";
  const Eigen::MatrixXd rest = rowColumnResistances(design, ElectrodeDisplacements::atRest(design));
  const Eigen::MatrixXd loaded = rowColumnResistances(design, displacements);
  for (Eigen::Index row = 0; row < rest.rows(); ++row)
    for (Eigen::Index column = 0; column < rest.cols(); ++column)
      text +=
          QString("%1,%2,").arg(row).arg(column) + number(rest(row, column)) + "," + number(loaded(row, column)) + "\n";
  return text;
}

void writeResultCsv(const QString& file, const SensorDesign& design, const ElectrodeDisplacements& displacements) {
  QSaveFile out(file);
  const QByteArray text = resultCsv(design, displacements).toUtf8();
  if (!out.open(QIODevice::WriteOnly) || out.write(text) != text.size() || !out.commit())
    throw Error((file + ": cannot be written (" + out.errorString() + "); allowed is a file in a folder that exists")
                    .toStdString());
}

} // namespace palp
