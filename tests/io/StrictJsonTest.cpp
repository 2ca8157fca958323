#include "io/StrictJson.h"

#include "io/DesignFile.h"
#include "tests/io/Refusal.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

/// What the reader says of `text` at its key "a".
template <class Read> std::string refusalOf(const std::string& text, Read&& read) {
  return refusal([&] {
    const Json json = parseJson(text, "x.json");
    read(JsonPlace(json, "x.json").at("a"));
  });
}

TEST(StrictJson, TakesWhatLiesWithinTheLimitsAndTheLimitsThemselves) {
  for (const char* text : {R"({"a": 2})", R"({"a": 3.0})", R"({"a": 5})"})
    EXPECT_EQ(refusalOf(text, [](const JsonPlace& a) { EXPECT_GE(a.integer(2, 5), 2); }), "") << text;
  EXPECT_EQ(refusalOf(R"({"a": 2.5})", [](const JsonPlace& a) { EXPECT_EQ(a.number(2.5, 3), 2.5); }), "");
}

TEST(StrictJson, SaysFileKeyValueAndLimits) {
  const auto whole = [](const JsonPlace& a) { static_cast<void>(a.integer(2, 5)); };
  for (const std::string value : {"1", "6", "2.5", "1e300", "\"3\"", "null", "[3]"})
    EXPECT_EQ(refusalOf("{\"a\": " + value + "}", whole).rfind("x.json: a: got ", 0), 0) << value;
  EXPECT_EQ(refusalOf(R"({"a": 7})", whole), "x.json: a: got 7, expected a whole number from 2 to 5");
  const auto real = [](const JsonPlace& a) { static_cast<void>(a.number(0, 0.5)); };
  EXPECT_EQ(refusalOf(R"({"a": 0.75})", real), "x.json: a: got 0.75, expected a number from 0 to 0.5");
}

TEST(StrictJson, SaysOfAFileThatIsCutOffWhereItEnds) {
  const std::string whole = "{\n  \"a\": [1,\n    \"two\"]\n}\n";
  const auto said = [](const std::string& text) { return refusal([&] { parseJson(text, "x.json"); }); };
  ASSERT_EQ(said(whole), "");
  for (std::size_t length = 1; length + 2 < whole.size(); ++length)
    EXPECT_EQ(said(whole.substr(0, length)).find("x.json: not valid JSON: the file ends early, at line "), 0U)
        << length << ": " << said(whole.substr(0, length));
  EXPECT_NE(said(whole.substr(0, whole.size() - 3)).find("at line 3:"), std::string::npos);
  EXPECT_EQ(said(" \n"), "x.json: not valid JSON: the file is empty");
  EXPECT_NE(said("{\"a\": x}").find("parse error at line 1"), std::string::npos) << "wrong, but not cut off";
  EXPECT_NE(said("{} }").find("parse error at line 1"), std::string::npos) << "more than one value";
}

TEST(StrictJson, RefusesAKeyThatStandsTwice) {
  const std::string sentence = refusal([] { parseJson(R"({"a": 1, "b": {"a": 2, "a": 3}})", "x.json"); });
  EXPECT_EQ(sentence, "x.json: key \"a\" appears twice");
}

/// Writing such a value into a refusal calls itself once a level: 32 MB of brackets would end the program.
TEST(StrictJson, RefusesListsThatLieTooDeepInEachOther) {
  constexpr std::size_t depth = 1 << 20;
  for (const auto& [open, close] : {std::pair{std::string("["), std::string("]")}, {"{\"a\":", "}"}}) {
    std::string text;
    for (std::size_t i = 0; i < depth; ++i) text += open;
    text += "1";
    for (std::size_t i = 0; i < depth; ++i) text += close;
    const std::string sentence = refusal([&] { parseDesign("{\"palp_design\": " + text + "}", "x.json"); });
    EXPECT_NE(sentence.find("nested lists and objects"), std::string::npos) << sentence;
  }
}

} // namespace
} // namespace palp
