#include "app/study/decoding/DesignMirror.h"

#include "model/FieldAtRest.h"
#include "model/RowColumnResistance.h"

#include <gtest/gtest.h>

#include <vector>

namespace palp {
namespace {

TEST(DesignMirror, OfThePaperExchangesItsWiresAlongBothAxes) {
  const SensorDesign design = paperDesign();
  const auto x = mirrorOf(design, 0), y = mirrorOf(design, 1);
  ASSERT_TRUE(x && y);
  for (int row = 0; row < design.rowWires(); ++row) {
    EXPECT_EQ(x->row[static_cast<std::size_t>(row)], row);
    EXPECT_EQ(y->row[static_cast<std::size_t>(row)], design.rowWires() - 1 - row);
  }
  for (int column = 0; column < design.columnWires(); ++column) {
    EXPECT_EQ(x->column[static_cast<std::size_t>(column)], design.columnWires() - 1 - column);
    EXPECT_EQ(y->column[static_cast<std::size_t>(column)], column);
  }
}

TEST(DesignMirror, LeavesTheResistancesAtRestAsTheyAre) {
  SensorDesign design = paperDesign(); // with uneven steps, and wires that differ along z
  design.lower.wire_mm[3] += 0.2;
  design.lower.wire_mm[static_cast<std::size_t>(design.columnWires()) - 4] -= 0.2;
  design.upper.z_mm.assign(10, std::vector<double>(10, 4)); // of ten row-wires with ten electrodes each
  design.upper.z_mm[2] = design.upper.z_mm[7] = std::vector<double>(10, 3.8);
  for (int axis = 0; axis < 2; ++axis) {
    const auto mirror = mirrorOf(design, axis);
    ASSERT_TRUE(mirror) << axis;
    const auto isImage = [&](const Eigen::MatrixXd& resistances_ohm) {
      const Eigen::MatrixXd image_ohm = resistances_ohm(mirror->row, mirror->column);
      return image_ohm.isApprox(resistances_ohm, 1e-9);
    };
    EXPECT_TRUE(isImage(rowColumnResistances(design, ElectrodeDisplacements::atRest(design)))) << axis;
    FieldLaw law;
    law.readout = Readout::VirtualGround;
    EXPECT_TRUE(isImage(NetworkReading(networkAtRest(design, law), law.readout).resistances_ohm())) << axis;
  }
}

TEST(DesignMirror, IsNoneWhereAnElectrodeHasNoImage) {
  SensorDesign design = paperDesign();
  design.upper.along_mm[0][0] += 0.1; // of all row-wires: y is reflected as before
  EXPECT_FALSE(mirrorOf(design, 0));
  EXPECT_TRUE(mirrorOf(design, 1));
  design = paperDesign();
  design.lower.wire_mm.back() -= 0.1;
  EXPECT_FALSE(mirrorOf(design, 0));
  EXPECT_TRUE(mirrorOf(design, 1));
  design = paperDesign();
  design.upper.z_mm.assign(10, std::vector<double>(10, 4)); // of ten row-wires with ten electrodes each
  design.upper.z_mm[2] = std::vector<double>(10, 3.8);
  EXPECT_TRUE(mirrorOf(design, 0));
  EXPECT_FALSE(mirrorOf(design, 1));
}

} // namespace
} // namespace palp
