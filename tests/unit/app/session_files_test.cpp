#include "app/session_files.h"

#include "core/error.h"
#include "session_example.h"

#include <gmock/gmock.h>

#include <ctime>

namespace onestroke {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class SessionFiles : public test::FolderTest {
 protected:
  /// Makes an empty file of the name that is given for so many seconds after noon.
  fs::path make(int seconds, std::size_t kept) {
    std::tm noon{};
    noon.tm_year = 126, noon.tm_mon = 10, noon.tm_mday = 26, noon.tm_hour = 12, noon.tm_sec = seconds;
    noon.tm_isdst = -1;
    fs::path made = new_session_file(sessions, std::mktime(&noon), kept);
    std::ofstream(made) << "x";
    return made.filename();
  }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : fs::directory_iterator(sessions)) all.push_back(entry.path().filename().string());
    std::ranges::sort(all);
    return all;
  }

  fs::path sessions;
  void SetUp() override {
    FolderTest::SetUp();
    sessions = folder / "state" / "sessions";
  }
};

TEST_F(SessionFiles, AreNamedByDateAndTime) {
  EXPECT_EQ(make(5, 10), "2026-11-26-120005.jsonl");
  EXPECT_EQ(make(5, 10), "2026-11-26-120005-2.jsonl") << "two in a second";
}

TEST_F(SessionFiles, TheNewestAreKept) {
  fs::create_directories(sessions);
  std::ofstream(sessions / "mine.jsonl") << "kept by a person";
  for (int i = 0; i < 5; ++i) make(i, 3);
  EXPECT_THAT(names(), ElementsAre("2026-11-26-120002.jsonl", "2026-11-26-120003.jsonl", "2026-11-26-120004.jsonl",
                                   "mine.jsonl"));
}

TEST_F(SessionFiles, AFolderThatCannotBeMadeIsAnError) {
  std::ofstream(folder / "state") << "in the way";
  try {
    make(0, 10);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("sessions cannot be made"));
  }
}

}  // namespace
}  // namespace onestroke
