// What the headset's display does as the runtime changes its mind: on the fake
// one, by the system's own loader.
#include "allocation/allocation_counter.h"
#include "desktop/x_server.h"
#include "headset/headset.h"

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

namespace onestroke {
namespace {

using testing::HasSubstr;

/// The fake runtime seen from behind. It stays between one instance and the
/// next as long as this does.
class FakeRuntime {
 public:
  FakeRuntime() : library_(dlopen(FAKE_RUNTIME, RTLD_NOW | RTLD_LOCAL)) {}
  FakeRuntime(const FakeRuntime&) = delete;
  ~FakeRuntime() {
    if (library_) dlclose(library_);
  }

  bool there() const { return library_; }
  void begin(const char* script) const {
    setenv("FAKE_RUNTIME_DOES", script, 1);
    reinterpret_cast<void (*)()>(dlsym(library_, "fake_runtime_begin"))();
  }
  int violations() const { return reinterpret_cast<int (*)()>(dlsym(library_, "fake_runtime_violations"))(); }

 private:
  void* library_;
};

class Runtime : public Headset {
 protected:
  void SetUp() override { ASSERT_TRUE(runtime.there()) << dlerror(); }
  void play(const char* script) {
    runtime.begin(script);
    Headset::SetUp();
  }
  void TearDown() override {
    Headset::TearDown();
    EXPECT_EQ(runtime.violations(), 0);
  }

  /// Goes on until something is so; whether it came to be. Counts the frames
  /// that were wanted, and those that were not.
  template <typename So>
  bool go_on_until(So&& so) {
    wanted = unwanted = 0;
    for (const Time until = Time::now() + longest_show; Time::now() < until;) {
      if (so()) return true;
      ++(blink() ? wanted : unwanted);
    }
    return false;
  }

  FakeRuntime runtime;
  int wanted = 0, unwanted = 0;
};

TEST_F(Runtime, ShowsFrames) {
  play("");
  show(50);
  EXPECT_EQ(shown.back().target->width, 128);
  for (std::size_t i = 1; i < shown.size(); ++i) EXPECT_GE(shown[i].time, shown[i - 1].time);
}

TEST_F(Runtime, MayEndTheShow) {
  play("exit@20");
  EXPECT_TRUE(go_on_until([this] { return display->closed(); }));
  EXPECT_EQ(wanted, 21);
  EXPECT_FALSE(display->gpu_lost());
  EXPECT_NO_THROW(display->finish());
}

TEST_F(Runtime, MayStopAndGoOn) {
  play("put_down@20");
  EXPECT_TRUE(go_on_until([this] { return wanted == 100; }));
  EXPECT_GT(unwanted, 10) << "while it is put down";
  EXPECT_LT(unwanted, 40);
  EXPECT_FALSE(display->closed() || display->gpu_lost());
}

TEST_F(Runtime, MayWantNothingDrawn) {
  play("unseen@20 unseen@50");
  EXPECT_TRUE(go_on_until([this] { return wanted == 100; }));
  EXPECT_GE(unwanted, 20);
  EXPECT_LT(unwanted, 25);
}

TEST_F(Runtime, MayBeLate) {
  play("late@20");
  show(60);
  for (std::size_t i = 1; i < shown.size(); ++i) EXPECT_GE(shown[i].time, shown[i - 1].time);
}

class RuntimeLoss : public Runtime, public testing::WithParamInterface<const char*> {};

TEST_P(RuntimeLoss, IsWaitedForAndTheShowGoesOn) {
  play(GetParam());
  const auto lost = [this] { return display->closed() || display->gpu_lost(); };
  ASSERT_TRUE(go_on_until(lost));
  ASSERT_FALSE(display->closed());
  EXPECT_GE(wanted, 20);
  EXPECT_LE(wanted, 21);
  EXPECT_GT(unwanted, 10) << "while it is away";
  start();
  EXPECT_FALSE(display->gpu_lost());
  show(20);
  EXPECT_FALSE(display->closed());
  display->finish();
  EXPECT_THAT(display->report().at(0), HasSubstr("in the headset a fake headset of a fake"));
}

INSTANTIATE_TEST_SUITE_P(Kinds, RuntimeLoss, testing::Values("session_loss@20", "instance_loss@20", "lost@20"),
                         [](const auto& kind) {
                           const std::string name = kind.param;
                           return name.substr(0, name.find('@'));
                         });

TEST_F(Runtime, EndsTheShowWhereItFails) {
  play("wait_error@20");
  EXPECT_TRUE(go_on_until([this] { return display->closed(); }));
  EXPECT_EQ(wanted, 20);
  try {
    display->finish();
    ADD_FAILURE();
  } catch (const std::exception& error) {
    EXPECT_THAT(error.what(), HasSubstr("restart the OpenXR runtime a fake (the OpenXR runtime wants no frame"));
  }
  renderer.reset();
  display.reset();
}

class WarmFrames : public Runtime {
 protected:
  /// What so many frames allocate, the driver's threads left out.
  long allocations_of(int frames) {
    long allocations = 0;
    for (int i = 0; i < frames; ++i) {
      const long before = test::allocations_of_this_thread();
      const bool drawn = blink();
      allocations += test::allocations_of_this_thread() - before;
      EXPECT_TRUE(drawn);
    }
    return allocations;
  }
};

TEST_F(WarmFrames, AllocateNothing) {
  validation = false;
  play("");
  show(20);
  EXPECT_EQ(allocations_of(50), 0);
}

TEST_F(WarmFrames, AllocateNothingBesideAMirror) {
  validation = false;
  options = {.title = "onestroke warm mirror", .mirror = true};
  play("");
  const test::XServer server;
  ASSERT_TRUE(server.answers()) << "this test needs an X server: run it with xvfb-run -a";
  const auto white = [&] {
    const auto id = server.find(options.title);
    return id && server.visible(id) && server.pixel(id, 3, 3) == std::array{255, 255, 255};
  };
  for (int i = 0; i < 100 && !white(); ++i) show(10, {1, 1, 1, 1});
  ASSERT_TRUE(white());
  EXPECT_EQ(allocations_of(50), 0);
  EXPECT_FALSE(white()) << "frames that are not white were shown as well";
}

TEST(ProgramOnTheFakeRuntime, EndsPlainlyWhenTheRuntimeAsks) {
  const std::string said = testing::TempDir() + "onestroke-exit.txt";
  const std::string command =
      "env -u DISPLAY -u WAYLAND_DISPLAY ONESTROKE_VALIDATION=1 FAKE_RUNTIME_DOES='unseen@5 put_down@20 exit@60' "
      "timeout 60 " ONESTROKE_PROGRAM
      " run --camera synthetic:script=still,width=320,height=240 --display openxr --log none >" +
      said + " 2>&1";
  const int status = std::system(command.c_str());
  std::ifstream file(said);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << text;
  EXPECT_THAT(text, HasSubstr("frames in the headset a fake headset of a fake"));
  EXPECT_THAT(text, testing::Not(testing::AnyOf(HasSubstr("fake runtime:"), HasSubstr("vulkan validation:"))));
}

}  // namespace
}  // namespace onestroke
