#include "app/study/live/ForceAlarm.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

TEST(ForceAlarm, GoesOffOnceAtItsSideAndIsOverWhereTheForceHasComeBack) {
  AlarmWatch watch;
  watch.set(ForceAlarm{ForceQuantity::Fz, AlarmSide::Below, -5});
  EXPECT_FALSE(watch.add(Eigen::Vector3d(6, 6, -4.99)));
  EXPECT_EQ(watch.add(Eigen::Vector3d(0, 0, -5.5)), "alarm: Fz -5.500 N is below -5 N");
  EXPECT_FALSE(watch.add(Eigen::Vector3d(0, 0, -4.9))) << "noise about the limit is one alarm";
  EXPECT_FALSE(watch.add(Eigen::Vector3d(0, 0, -5.1)));
  EXPECT_EQ(watch.words(), "alarm: Fz -5.100 N is below -5 N") << "the present force";
  EXPECT_EQ(watch.add(Eigen::Vector3d(0, 0, -4)), "alarm over");
  EXPECT_TRUE(watch.words().empty());
}

TEST(ForceAlarm, IsOverWhereThereAreNoForcesAnyMore) {
  AlarmWatch watch;
  EXPECT_FALSE(watch.lose()) << "nothing lasts";
  watch.set(ForceAlarm{ForceQuantity::Fz, AlarmSide::Below, -5});
  EXPECT_TRUE(watch.add(Eigen::Vector3d(0, 0, -6)));
  EXPECT_EQ(watch.lose(), "alarm over");
  EXPECT_TRUE(watch.words().empty());
  EXPECT_TRUE(watch.add(Eigen::Vector3d(0, 0, -6))) << "it goes off again with the next force";
}

TEST(ForceAlarm, NearALimitOfZeroIsOverByAShareOfTheForceRange) {
  for (const double unit : {1e-3, 1., 1e3}) {
    AlarmWatch watch;
    watch.setRange(6 * unit);
    watch.set(ForceAlarm{ForceQuantity::Fx, AlarmSide::Above, 0});
    EXPECT_TRUE(watch.add(unit * Eigen::Vector3d(0.1, 0, -1))) << unit;
    EXPECT_FALSE(watch.add(unit * Eigen::Vector3d(-0.019, 0, -1))) << unit << ": noise";
    EXPECT_EQ(watch.add(unit * Eigen::Vector3d(-0.021, 0, -1)), "alarm over") << unit;
  }
}

TEST(ForceAlarm, LooksAtEveryArea) {
  AlarmWatch watch;
  watch.set(ForceAlarm{ForceQuantity::Fx, AlarmSide::Above, 2});
  Eigen::Matrix3Xd forces_N(3, 3);
  forces_N << 2.5, 0, 0, 0, 0, 0, -1, -5, 0; // the largest force lies on area 1
  EXPECT_EQ(watch.add(forces_N), "alarm: Fx 2.500 N on area 0 is above 2 N");
  forces_N.col(0).setZero();
  forces_N(0, 2) = 2.2;
  EXPECT_FALSE(watch.add(forces_N)) << "it lasts, on another area";
  EXPECT_EQ(watch.words(), "alarm: Fx 2.200 N on area 2 is above 2 N");
  forces_N(0, 2) = 0;
  EXPECT_EQ(watch.add(forces_N), "alarm over");
}

TEST(ForceAlarm, AnAreaThatNothingPressesIsNoForceTooSmall) {
  AlarmWatch watch;
  watch.set(ForceAlarm{ForceQuantity::Fz, AlarmSide::Above, -1}); // the force has gone
  Eigen::Matrix3Xd forces_N = Eigen::Matrix3Xd::Zero(3, 2);
  forces_N(2, 1) = -5;
  EXPECT_FALSE(watch.add(forces_N));
  forces_N(2, 0) = -0.5;
  EXPECT_TRUE(watch.add(forces_N)) << "pressed, and too little";
  forces_N(2, 0) = 0;
  EXPECT_EQ(watch.add(forces_N), "alarm over");
  EXPECT_TRUE(watch.add(Eigen::Matrix3Xd::Zero(3, 2))) << "nothing presses";
}

TEST(ForceAlarm, CountsTheLargestForceAndItsSize) {
  AlarmWatch watch;
  watch.set(ForceAlarm{ForceQuantity::Size, AlarmSide::Above, 4});
  Eigen::Matrix3Xd forces_N = Eigen::Matrix3Xd::Zero(3, 2);
  EXPECT_FALSE(watch.add(forces_N));
  forces_N.col(1) = Eigen::Vector3d(3, 0, -4);
  EXPECT_EQ(watch.add(forces_N), "alarm: |F| 5.000 N on area 1 is above 4 N");
  watch.set({});
  EXPECT_FALSE(watch.add(forces_N));
  EXPECT_TRUE(watch.words().empty());
}

} // namespace
} // namespace palp
