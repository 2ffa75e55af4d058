// `onestroke run`, the built program as a person runs it, into files.
#include "golden/comparator.h"
#include "shell.h"

#include <gmock/gmock.h>

namespace onestroke {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

std::ptrdiff_t count_of(const fs::path& folder, const std::string& ending) {
  return std::count_if(fs::directory_iterator(folder), {},
                       [&](const fs::directory_entry& e) { return e.path().extension() == ending; });
}

/// Where the demo's catalogue has the object that tells of a version's model, and how long it is.
std::pair<std::size_t, std::size_t> model_in(const std::string& catalog, const std::string& version) {
  const std::size_t begin = catalog.rfind('{', catalog.find("bracket_" + version + ".glb"));
  const std::string end = "}}";  // of the notes, and of the model
  return {begin, begin == std::string::npos ? 0 : catalog.find(end, begin) + end.size() - begin};
}

class RunProgram : public ProgramTest {
 protected:
  const std::string small = "run --camera synthetic:script=still,width=320,height=240 ";
};

TEST_F(RunProgram, DrawsTheDemoIntoFiles) {
  const Ended ended = run("run --display offscreen:film --frames 20");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.err, "") << "nothing to say for validation either";
  EXPECT_THAT(ended.out, AllOf(HasSubstr("film/film.mp4, 20 frames"), HasSubstr("frame_000019.png")));
  EXPECT_EQ(count_of(folder / "film", ".png"), 20);
  EXPECT_GT(fs::file_size(folder / "film" / "film.mp4"), 10'000u);
  const golden::Picture first = golden::read_png(folder / "film" / "frame_000000.png");
  EXPECT_EQ(first.width, 1280);
  EXPECT_EQ(first.height, 720);
}

TEST_F(RunProgram, WithoutADesktopGoesIntoFilesByItself) {
  const Ended ended = run("run --frames 2");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(count_of(folder / "out" / "demo", ".png"), 2);
}

TEST_F(RunProgram, ShowsAPictureForEachEye) {
  const Ended ended = run(small + "--display offscreen:pair --stereo --frames 3");
  EXPECT_EQ(ended.code, 0) << ended.err;
  const golden::Picture pair = golden::read_png(folder / "pair" / "frame_000002.png");
  ASSERT_EQ(pair.width, 2560);
  ASSERT_EQ(pair.height, 720);
  // What is near is seen in different places, so the halves differ.
  int differing = 0;
  for (int y = 0; y < pair.height; ++y)
    for (int x = 0; x < 1280; ++x) differing += pair.at(x, y)[1] != pair.at(x + 1280, y)[1];
  EXPECT_GT(differing, 1280 * 720 / 20);
  const Ended window = run(small + "--display window --stereo --frames 3");
  EXPECT_EQ(window.code, 2);
  EXPECT_NE(window.err.find("leave it out"), std::string::npos) << window.err;
}

TEST_F(RunProgram, ShowsTheSameTwice) {
  const std::string options = small + "--display offscreen:";
  EXPECT_EQ(run(options + "a --frames 8").code, 0);
  EXPECT_EQ(run(options + "b --frames 8").code, 0);
  // The line at the foot tells how long the tracker took.
  const auto upper = [&](const std::string& film) {
    golden::Picture p = golden::read_png(folder / film / "frame_000007.png");
    p.height -= 60;
    p.rgb.resize(3 * static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height));
    return p;
  };
  EXPECT_TRUE(golden::compare(upper("a"), upper("b"), {.level = 0}).same);
}

TEST_F(RunProgram, EndsWithTheTimeOrTheCamera) {
  EXPECT_EQ(run(small + "--display offscreen:a --seconds 0.2").code, 0);
  EXPECT_EQ(count_of(folder / "a", ".png"), 6);
  EXPECT_EQ(run("run --camera synthetic:script=still,width=320,height=240,seconds=0.1 --display offscreen:b").code, 0);
  EXPECT_EQ(count_of(folder / "b", ".png"), 3);
}

TEST_F(RunProgram, MarkersWithoutAModelAreShownAllTheSame) {
  ASSERT_EQ(run("marker import " + demo_catalog + " --catalog bare.db").code, 0);
  ASSERT_EQ(run("marker export --catalog bare.db --output bare.json").code, 0);
  std::string text = read("bare.json");
  for (const std::string version : {"v1", "v2"}) {
    const auto [begin, size] = model_in(text, version);
    ASSERT_NE(begin, std::string::npos) << text;
    const std::string key = ",\"model\":";
    text.erase(begin - key.size(), size + key.size());
  }
  write("bare.json", text);
  const Ended ended = run("run --camera synthetic:script=still --catalog bare.json --display offscreen:a --frames 8");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  EXPECT_EQ(count_of(folder / "a", ".png"), 8);
}

TEST_F(RunProgram, KeepsItsPipelinesForTheNextRun) {
  cache = folder / "cache";
  for (int i = 0; i < 2; ++i) {
    const Ended ended = run(small + "--display offscreen:a --frames 2");
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.err, "");
    EXPECT_EQ(count_of(cache / "onestroke", ".bin"), 1);
  }
  write("file", "in the way");
  cache = folder / "file";
  EXPECT_EQ(run(small + "--display offscreen:a --frames 2").code, 0);
}

TEST_F(RunProgram, ShowsModelsOfEveryKind) {
  std::string text = read(demo_catalog);
  for (const auto& [version, to] :
       {std::pair{"v1", R"({"file": "part.stl", "unit": "cm", "up": "y"})"}, std::pair{"v2", R"("part.obj")"}}) {
    const auto [begin, size] = model_in(text, version);
    ASSERT_NE(begin, std::string::npos) << text;
    text.replace(begin, size, to);
  }
  write("parts.json", text);
  write("part.stl",
        "solid part\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 4 0 0\nvertex 0 4 0\nendloop\nendfacet\n"
        "endsolid part\n");
  write("part.obj", "v 0 0 0\nv 40 0 0\nv 0 40 0\nf 1 2 3\n");
  const Ended ended = run("run --camera synthetic:script=still --catalog parts.json --display offscreen:a --frames 4");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  EXPECT_EQ(count_of(folder / "a", ".png"), 4);
}

TEST_F(RunProgram, SaysWhatIsWrong) {
  const Ended usage = run("run --fresh");
  EXPECT_EQ(usage.code, 2);
  EXPECT_THAT(usage.err, HasSubstr("onestroke run --help"));
  const Ended catalog = run("run --catalog none.db --display offscreen:a");
  EXPECT_EQ(catalog.code, 1);
  EXPECT_THAT(catalog.err, HasSubstr("none.db cannot be read"));
  const Ended assets = run("run --display offscreen:a", "ONESTROKE_ASSETS=elsewhere");
  EXPECT_EQ(assets.code, 1);
  EXPECT_THAT(assets.err, AllOf(HasSubstr("elsewhere/catalog.json"), HasSubstr("ONESTROKE_ASSETS")));
  // The catalogue's models are looked for beside it.
  fs::copy_file(demo_catalog, folder / "catalog.json");
  const Ended model = run("run --catalog catalog.json --display offscreen:a");
  EXPECT_EQ(model.code, 1);
  EXPECT_THAT(model.err, AllOf(HasSubstr("marker 1 (bracket v1)"), HasSubstr("bracket_v1.glb")));
  const Ended window = run("run --display window");
  EXPECT_EQ(window.code, 1);
  EXPECT_THAT(window.err, HasSubstr("--display offscreen:DIR"));
  const Ended gpu = run("run --gpu nothing --display offscreen:a");
  EXPECT_EQ(gpu.code, 1);
  EXPECT_THAT(gpu.err, AllOf(HasSubstr("no GPU is called \"nothing\""), HasSubstr("of 0 ")));
  for (const Ended& ended : {catalog, assets, model, window, gpu})
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
}

}  // namespace
}  // namespace onestroke
