#include "app/study/live/trust/DeviationNote.h"

#include "app/study/decoding/CalibrationMark.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

Decoder network() {
  Decoder decoder;
  decoder.designFingerprint = "a";
  decoder.residual_N = Eigen::Vector3d(0.01, 0.02, 0.3);
  return decoder;
}

TEST(DeviationNote, SaysNothingOfASimulatedBoardOfTheNetworksDesign) {
  const DeviationNote note = deviationNote(network(), {"a", true});
  EXPECT_FALSE(note.wrong);
  EXPECT_EQ(note.brief + note.sentence, "");
}

TEST(DeviationNote, SaysThatTheNetworkIsOfAnotherDesign) {
  const DeviationNote note = deviationNote(network(), {"b", true});
  EXPECT_TRUE(note.wrong);
  EXPECT_EQ(note.brief, "another design");
  EXPECT_FALSE(deviationNote(network(), {"", true}).wrong) << "not known";
}

TEST(DeviationNote, SaysThatABoardWasNotCalibratedOrWhatThatLeft) {
  Decoder decoder = network();
  EXPECT_EQ(deviationNote(decoder, {"a"}).brief, "uncalibrated");
  decoder.trainedWith = withCalibrationMark(decoder.trainedWith, 12);
  EXPECT_EQ(deviationNote(decoder, {"a"}).sentence,
            "the network is calibrated with 12 frames, which left (0.01, 0.02, 0.3) N");
  EXPECT_EQ(deviationNote(decoder, {"a"}).brief, "");
}

TEST(DeviationNote, SaysThatAnIndenterPressesWhereTheNetworkKnowsWholeAreas) {
  Decoder decoder = network();
  EXPECT_TRUE(deviationNote(decoder, {"a", true, true}).wrong);
  decoder.touches = "sphere:3..6";
  EXPECT_FALSE(deviationNote(decoder, {"a", true, true}).wrong);
}

} // namespace
} // namespace palp
