#include "model/base/NamedEnum.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

enum class Colour { Red, Green, Blue };
constexpr NamedEnum kColours("colour", std::array{std::pair{Colour::Red, "red"}, std::pair{Colour::Green, "green"}});

TEST(NamedEnum, KnowsItsNamesInBothDirections) {
  EXPECT_EQ(kColours.name(Colour::Green), "green");
  EXPECT_EQ(kColours.value("green"), Colour::Green);
  EXPECT_EQ(kColours.find("red"), Colour::Red);
}

TEST(NamedEnum, AValueWithoutANameHasAnEmptyOne) {
  EXPECT_EQ(kColours.name(Colour::Blue), "");
  EXPECT_FALSE(kColours.find(""));
}

TEST(NamedEnum, AnUnknownNameIsRefusedWithTheAllowedOnes) {
  EXPECT_FALSE(kColours.find("Red"));
  try {
    static_cast<void>(kColours.value("blue"));
    FAIL();
  } catch (const Error& refusal) {
    EXPECT_STREQ(refusal.what(), "colour: got 'blue', expected red or green");
  }
}

TEST(NamedEnum, ListsWhatIsAllowedAsASentenceDoes) {
  constexpr NamedEnum all("colour", std::array{std::pair{Colour::Red, "red"}, std::pair{Colour::Green, "green"},
                                               std::pair{Colour::Blue, "blue"}});
  EXPECT_EQ(all.allowed(), "red, green or blue");
  constexpr NamedEnum one("colour", std::array{std::pair{Colour::Red, "red"}});
  EXPECT_EQ(one.allowed(), "red");
}

} // namespace
} // namespace palp
