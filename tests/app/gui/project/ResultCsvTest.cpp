#include "app/gui/project/ResultCsv.h"

#include "io/DesignFile.h"
#include "model/SensorDesign.h"

#include <QRegularExpression>
#include <QStringList>

#include <gtest/gtest.h>

namespace palp {
namespace {

const LoadCase kLoad{{{1, {0.5, 0.25, -6}}}, {{{10, 12}, 2.5, {0, 0, -1}}}};

/// The lines of a table below those that say what it was computed from.
QStringList tableOf(const QString& text) {
  QStringList lines = text.trimmed().split('\n');
  while (lines.front().startsWith('#')) lines.removeFirst();
  return lines;
}

TEST(ResultCsv, HoldsOneTableAFile) {
  const SensorDesign design = paperDesign();
  const ElectrodeDisplacements rest = ElectrodeDisplacements::atRest(design);
  const QStringList electrodes = tableOf(electrodesCsv({design, kLoad}, rest));
  ASSERT_EQ(electrodes.size(), 1 + 100 + 90);
  const QStringList resistances = tableOf(resistancesCsv({design, kLoad}, *resistancesOf(design, rest)));
  ASSERT_EQ(resistances.size(), 1 + 300);
  for (const QStringList& table : {electrodes, resistances})
    for (const QString& line : table) EXPECT_EQ(line.count(','), table.front().count(',')) << line.toStdString();
}

TEST(ResultCsv, HoldsTheElectrodesOfBothLayersAndSaysWhetherTheLowerOnesMove) {
  SensorDesign design = paperDesign();
  ElectrodeDisplacements moved = ElectrodeDisplacements::atRest(design);
  moved.upper_mm.row(2).setConstant(-0.25);
  moved.lower_mm.row(0).setConstant(0.125);
  for (const bool follows : {false, true}) {
    design.lowerFollowsRubber = follows;
    const QString text = electrodesCsv({design, kLoad}, moved);
    EXPECT_EQ(text.contains("fixed in the design"), !follows);
    const QStringList table = tableOf(text);
    EXPECT_EQ(table.filter(QRegularExpression("^upper,.*,0,0,-0.25$")).size(), design.upper.electrodes());
    EXPECT_EQ(table.filter(QRegularExpression(follows ? "^lower,.*,0.125,0,0$" : "^lower,.*,0,0,0$")).size(),
              design.lower.electrodes());
    const Eigen::Vector3d last = design.lowerElectrodes_mm().rightCols<1>();
    const QStringList cells = table.back().split(',');
    EXPECT_EQ(cells[1].toInt(), design.columnWires() - 1);
    EXPECT_EQ(cells[2].toInt(), design.electrodesPerColumnWire() - 1);
    for (int d = 0; d < 3; ++d) EXPECT_EQ(cells[3 + d].toDouble(), last[d]);
  }
}

TEST(ResultCsv, SaysTheLoadAndTheDesignItWasComputedFrom) {
  SensorDesign design = paperDesign();
  design.block_mm.z() = 6;
  const QString text =
      resistancesCsv({design, kLoad, 0.5}, *resistancesOf(design, ElectrodeDisplacements::atRest(design)));
  EXPECT_TRUE(text.contains("# palp, share of the load 0.5\n"));
  EXPECT_TRUE(text.contains("# load on area 1: (0.5, 0.25, -6) N\n"));
  EXPECT_TRUE(text.contains("# load on a disc at (10, 12) mm with radius 2.5 mm: (0, 0, -1) N\n"));
  LoadCase third = kLoad;
  third.areas[0].force_N.y() = 0.3; // which has no exact binary number
  EXPECT_TRUE(sourceLines({design, third}).contains("# load on area 1: (0.5, 0.3, -6) N\n"));
  const QString json = text.section("# design ", 1).section('\n', 0, 0);
  EXPECT_EQ(parseDesign(json.toStdString(), "table"), design);
}

} // namespace
} // namespace palp
