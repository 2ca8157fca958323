#include "app/study/Resources.h"

#include "app/study/Failure.h"
#include "model/base/Error.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

TEST(Resources, AFileThatIsMissingIsNamedWithTheFoldersThatWereLookedIn) {
  EXPECT_TRUE(std::filesystem::exists(resource("docs/architecture.md")));
  try {
    (void)resource("board/no-such-network.json");
    ADD_FAILURE() << "found";
  } catch (const Error& missing) {
    const std::string words = missing.what();
    EXPECT_TRUE(words.starts_with("board/no-such-network.json: ")) << words;
    EXPECT_NE(words.find("/usr/share/palp"), std::string::npos) << words;
  }
}

TEST(Failure, OfTheFileSystemNamesTheFileAndTheReason) {
  try {
    (void)std::filesystem::exists(std::string(300, 'n'));
    ADD_FAILURE() << "taken";
  } catch (...) {
    const std::string words = failureInWords(std::current_exception());
    EXPECT_TRUE(words.starts_with(std::string(300, 'n') + ": ")) << words;
    EXPECT_TRUE(words.ends_with("File name too long")) << words;
  }
}

} // namespace
} // namespace palp
