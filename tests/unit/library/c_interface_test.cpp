// The C interface: codes, messages, and null pointers of every kind.

#include "held_marker.h"
#include "library/onestroke_c.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <thread>

namespace onestroke::test {
namespace {

using ::testing::HasSubstr;
using Handle = std::unique_ptr<onestroke_tracker, decltype(&onestroke_destroy)>;

class CInterface : public ::testing::Test {
 protected:
  void SetUp() override {
    lens.horizontal_fov_deg = HeldMarker::fov_deg;
    picture.data = scene.image.rgb.data();
    picture.stride = 3 * std::size_t{HeldMarker::width};
    picture.width = HeldMarker::width;
    picture.height = HeldMarker::height;
  }

  Handle create() const {
    return {onestroke_create_from_json(to_json(scene.catalog).c_str(), &lens, 0), &onestroke_destroy};
  }

  const HeldMarker scene{};
  onestroke_lens lens{};
  onestroke_picture picture{};
};

TEST_F(CInterface, FindsTheMarker) {
  const Handle tracker = create();
  ASSERT_NE(tracker, nullptr) << onestroke_last_error();
  picture.exposure_start_ns = 70;
  ASSERT_EQ(onestroke_process(tracker.get(), &picture), ONESTROKE_OK) << onestroke_last_error();
  EXPECT_EQ(onestroke_time_ns(tracker.get()), 70);
  onestroke_marker markers[2];
  ASSERT_EQ(onestroke_markers(tracker.get(), markers, 2), 1u);
  EXPECT_EQ(markers[0].id, scene.held.id);
  EXPECT_STREQ(markers[0].name, scene.held.name.c_str());
  EXPECT_EQ(markers[0].state, ONESTROKE_MEASURED);
  EXPECT_GT(markers[0].cells_seen, 30);
  EXPECT_NEAR(markers[0].rotation[1], to_matrix(scene.T_camera_marker.rotation)[0][1], 0.01);
  EXPECT_NEAR(markers[0].translation_mm[2], scene.T_camera_marker.translation.z, 1.5);
  EXPECT_GT(markers[0].covariance[35], 0);
}

TEST_F(CInterface, ASmallArrayIsNotOverrun) {
  const Handle tracker = create();
  ASSERT_EQ(onestroke_process(tracker.get(), &picture), ONESTROKE_OK);
  onestroke_marker untouched{};
  untouched.id = -5;
  EXPECT_EQ(onestroke_markers(tracker.get(), &untouched, 0), 1u);
  EXPECT_EQ(onestroke_markers(tracker.get(), nullptr, 0), 1u);
  EXPECT_EQ(untouched.id, -5);
}

TEST_F(CInterface, ABadPictureIsRefusedAndLeavesNoMarkers) {
  const Handle tracker = create();
  ASSERT_EQ(onestroke_process(tracker.get(), &picture), ONESTROKE_OK);
  onestroke_picture bad = picture;
  bad.layout = 9;
  EXPECT_EQ(onestroke_process(tracker.get(), &bad), ONESTROKE_BAD_ARGUMENT);
  EXPECT_THAT(onestroke_last_error(), HasSubstr("layout 9 is unknown"));
  EXPECT_EQ(onestroke_markers(tracker.get(), nullptr, 0), 0u);
  bad = picture;
  bad.data = nullptr;
  EXPECT_EQ(onestroke_process(tracker.get(), &bad), ONESTROKE_BAD_ARGUMENT);
  EXPECT_THAT(onestroke_last_error(), HasSubstr("data is null"));
  EXPECT_EQ(onestroke_process(tracker.get(), &picture), ONESTROKE_OK);
}

TEST_F(CInterface, NullPointersAreNamed) {
  const Handle tracker = create();
  EXPECT_EQ(onestroke_process(nullptr, &picture), ONESTROKE_BAD_ARGUMENT);
  EXPECT_STREQ(onestroke_last_error(), "tracker is NULL");
  EXPECT_EQ(onestroke_process(tracker.get(), nullptr), ONESTROKE_BAD_ARGUMENT);
  EXPECT_STREQ(onestroke_last_error(), "picture is NULL");
  EXPECT_EQ(onestroke_create_from_json(nullptr, &lens, 0), nullptr);
  EXPECT_STREQ(onestroke_last_error(), "catalog_text is NULL");
  EXPECT_EQ(onestroke_create_from_file("catalog.json", nullptr, 0), nullptr);
  EXPECT_STREQ(onestroke_last_error(), "lens is NULL");
  EXPECT_EQ(onestroke_markers(nullptr, nullptr, 0), 0u);
  EXPECT_EQ(onestroke_time_ns(nullptr), 0);
  onestroke_destroy(nullptr);
}

TEST_F(CInterface, ABadCatalogueOrLensMakesNoTracker) {
  EXPECT_EQ(onestroke_create_from_json(R"({"markers": [{"id": "x"}]})", &lens, 0), nullptr);
  EXPECT_THAT(onestroke_last_error(), HasSubstr("marker 1: \"id\" must be a whole number"));
  EXPECT_EQ(onestroke_create_from_file("/no/such.json", &lens, 0), nullptr);
  EXPECT_THAT(onestroke_last_error(), HasSubstr("/no/such.json"));
  lens.horizontal_fov_deg = 200;
  EXPECT_EQ(create(), nullptr);
  EXPECT_THAT(onestroke_last_error(), HasSubstr("horizontal_fov_deg must be 1 to 179"));
}

TEST_F(CInterface, ALongMessageIsCutAndEachThreadHasItsOwn) {
  EXPECT_EQ(onestroke_create_from_file(std::string(5000, 'x').c_str(), &lens, 0), nullptr);
  EXPECT_EQ(std::string(onestroke_last_error()), std::string(1023, 'x'));
  std::thread([] { EXPECT_STREQ(onestroke_last_error(), ""); }).join();
}

}  // namespace
}  // namespace onestroke::test
