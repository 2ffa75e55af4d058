// `onestroke run --log` and `--replay`, the built program as a person runs it, into files.
#include "shell.h"

#include <gmock/gmock.h>

namespace onestroke {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class SessionProgram : public ProgramTest {
 protected:
  // Both hands are there after a second; four pictures make one.
  const std::string demo = "run --camera synthetic:fingers=1,noise=2,blur=0.5,width=640,height=360,fps=4 ";

  std::ptrdiff_t pictures(const std::string& name) const {
    return std::count_if(fs::directory_iterator(folder / name), {},
                         [](const fs::directory_entry& e) { return e.path().extension() == ".png"; });
  }
  int count_in(const std::string& name, const std::string& wanted) const {
    const std::string text = read(name);
    int count = 0;
    for (std::size_t at = text.find(wanted); at != std::string::npos; at = text.find(wanted, at + 1)) ++count;
    return count;
  }
  /// Byte for byte, the figures at the foot too.
  void expect_same_pictures(const std::string& a, const std::string& b, std::ptrdiff_t count) const {
    ASSERT_EQ(pictures(a), count);
    ASSERT_EQ(pictures(b), count);
    for (const auto& entry : fs::directory_iterator(folder / a)) {
      if (entry.path().extension() != ".png") continue;
      const std::string name = entry.path().filename().string();
      EXPECT_TRUE(read(a + "/" + name) == read(b + "/" + name)) << name;
    }
  }
};

TEST_F(SessionProgram, IsShownAgainPictureForPicture) {
  const Ended first = run(demo + "--display offscreen:film --frames 20");
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("wrote film/session.jsonl"));
  const Ended again = run("run --replay film/session.jsonl --display offscreen:again");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(again.err, "");
  expect_same_pictures("film", "again", 20);
  for (const std::string name : {R"("name":"bracket v1")", R"("name":"bracket v2")"})
    EXPECT_GT(count_in("film/session.jsonl", name), 8) << "there was something to show";
  EXPECT_FALSE(fs::exists(folder / "again" / "session.jsonl"));
}

TEST_F(SessionProgram, IsShownAgainForTwoEyesAndFromAnywhere) {
  fs::create_directory(folder / "else");
  ASSERT_EQ(run(demo + "--display offscreen:film --stereo --no-fingers --log log.jsonl --frames 4").code, 0);
  EXPECT_FALSE(fs::exists(folder / "film" / "session.jsonl"));
  const Ended again = run("run --replay ../log.jsonl --display offscreen:../again", "cd else &&");
  EXPECT_EQ(again.code, 0) << read("else/err.txt");
  expect_same_pictures("film", "again", 4);
}

TEST_F(SessionProgram, BothCamerasOfAPairAreShownAgain) {
  const Ended first =
      run(demo + "--second-camera synthetic --baseline-mm 64 --stereo --display offscreen:film --frames 8");
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(first.err, "") << "nothing to say for validation either";
  EXPECT_GT(count_in("film/session.jsonl", "second_cells"), 2) << "both cameras saw sticks";
  const Ended again = run("run --replay film/session.jsonl --display offscreen:again");
  EXPECT_EQ(again.code, 0) << again.err;
  expect_same_pictures("film", "again", 8);
}

TEST_F(SessionProgram, ACutLogIsShownAsFarAsItGoes) {
  ASSERT_EQ(run(demo + "--display offscreen:film --frames 4").code, 0);
  const std::string whole = read("film/session.jsonl");
  write("cut.jsonl", whole.substr(0, whole.size() - 40));
  const Ended again = run("run --replay cut.jsonl --display offscreen:again");
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.err, AllOf(HasSubstr("cut.jsonl"), HasSubstr("line 5 is cut short")));
  EXPECT_EQ(pictures("again"), 3);
}

TEST_F(SessionProgram, DarkPicturesStandForACameraThatIsGone) {
  ASSERT_EQ(run("track --catalog " + demo_catalog +
                " --camera synthetic:script=still,width=320,height=240 --frames 2 --overlay shots --output p.jsonl")
                .code,
            0);
  ASSERT_EQ(run("run --camera folder:shots --fov 50 --display offscreen:film").code, 0);
  fs::rename(folder / "shots", folder / "moved");
  const Ended dark = run("run --replay film/session.jsonl --display offscreen:dark");
  EXPECT_EQ(dark.code, 0);
  EXPECT_THAT(dark.err, AllOf(HasSubstr("shots"), HasSubstr("dark pictures")));
  EXPECT_EQ(pictures("dark"), 2);
  const Ended again = run("run --replay film/session.jsonl --camera folder:moved --display offscreen:again");
  EXPECT_EQ(again.err, "");
  expect_same_pictures("film", "again", 2);
  EXPECT_EQ(run("run --replay film/session.jsonl --camera folder:none --display offscreen:none").code, 1);
}

TEST_F(SessionProgram, SaysWhatIsWrong) {
  write("not.jsonl", "{\"markers\": []}\n");
  const Ended other = run("run --replay not.jsonl --display offscreen:a");
  EXPECT_THAT(other.err, HasSubstr("not.jsonl is no log of a session"));
  const Ended none = run("run --replay none.jsonl --display offscreen:a");
  EXPECT_THAT(none.err, HasSubstr("none.jsonl cannot be read"));
  const Ended unwritable = run(demo + "--log none/a.jsonl --display offscreen:a --frames 1");
  EXPECT_THAT(unwritable.err, HasSubstr("none/a.jsonl cannot be written"));
  for (const Ended& ended : {other, none, unwritable}) {
    EXPECT_EQ(ended.code, 1);
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  }
  EXPECT_EQ(run("run --replay not.jsonl --catalog c.db").code, 2);
}

TEST_F(SessionProgram, IsNotWrittenDownWhereThatIsNotWanted) {
  const Ended ended = run(demo + "--display offscreen:film --log none --frames 2");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_FALSE(fs::exists(folder / "film" / "session.jsonl"));
  EXPECT_FALSE(fs::exists(folder / "none"));
}

}  // namespace
}  // namespace onestroke
