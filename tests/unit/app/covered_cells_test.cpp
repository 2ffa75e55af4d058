#include "app/covered_cells.h"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>

namespace onestroke {
namespace {

class Covered : public testing::Test {
 protected:
  Covered() : gpu({}), renderer(gpu), shelf(catalog, ONESTROKE_SOURCE_DIR "/assets", renderer), covered(shelf) {
    picture.width = 1280;
    picture.height = 720;
    picture.intrinsics = Intrinsics::from_fov(1280, 720, 1.0);
    record->marker_count = 1;
    marker().id = catalog.markers.front().id;
    marker().state = MarkerState::measured;
    marker().T_camera_marker = {exp_so3({0.2, 0.1, 0}), {-20, 20, 450}};
    see_all_but(0, 0);
  }

  MarkerObservation& marker() { return record->markers[0]; }
  int cells() const { return catalog.markers.front().shape.cells(); }
  void see_all_but(int first, int end) {
    marker().cells_seen = 0;
    for (int i = 0; i < cells(); ++i)
      if (i < first || i >= end) marker().cells[static_cast<std::size_t>(marker().cells_seen++)].index = i;
  }

  const Catalog catalog = load_catalog(ONESTROKE_SOURCE_DIR "/assets/catalog.json");
  Gpu gpu;
  Renderer renderer;
  ModelShelf shelf;
  CoveredCells covered;
  Picture picture;
  const std::unique_ptr<FrameRecord> record = std::make_unique<FrameRecord>();
};

TEST_F(Covered, AreThoseThatAreNotSeen) {
  EXPECT_TRUE(covered.find(*record, picture).empty());
  see_all_but(5, 9);
  const auto found = covered.find(*record, picture);
  ASSERT_EQ(found.size(), 4U);
  const MarkerSpec& spec = catalog.markers.front();
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double s = (5.5 + static_cast<double>(i)) * spec.shape.pitch();
    EXPECT_LT(norm(found[i].at - marker().T_camera_marker * spec.shape.at(s).position), 1e-9);
    EXPECT_EQ(found[i].stick, spec.id);
  }
}

TEST_F(Covered, AreInTheSecondPictureThoseThatItDoesNotShow) {
  record->T_world_camera = {exp_so3({0, 0.3, 0}), {10, 0, 0}};
  Picture second = picture;
  const Pose T_first_second{exp_so3({0, 0.05, 0}), {64, 0, 0}};
  second.T_world_camera = record->T_world_camera * T_first_second;
  EXPECT_TRUE(covered.find_in_second(*record, second).empty()) << "nothing is known of it there";
  const std::uint64_t all = (1ULL << cells()) - 1;
  marker().second_cells = all & ~(0b1111ULL << 5);
  const auto found = covered.find_in_second(*record, second);
  ASSERT_EQ(found.size(), 4U);
  const MarkerSpec& spec = catalog.markers.front();
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Vec3 cell = spec.shape.at((5.5 + static_cast<double>(i)) * spec.shape.pitch()).position;
    EXPECT_LT(norm(T_first_second * found[i].at - marker().T_camera_marker * cell), 1e-9);
  }
  EXPECT_TRUE(covered.find(*record, picture).empty()) << "the first one shows all";
}

TEST_F(Covered, AreNotSingleOnesThatGlare) {
  see_all_but(5, 6);
  EXPECT_TRUE(covered.find(*record, picture).empty());
}

TEST_F(Covered, AreNotThoseOfAStickThatIsLostOrOutsideThePicture) {
  see_all_but(5, 9);
  marker().state = MarkerState::predicted;
  EXPECT_TRUE(covered.find(*record, picture).empty());
  marker().state = MarkerState::measured;
  marker().T_camera_marker.translation = {-2000, 0, 450};
  EXPECT_TRUE(covered.find(*record, picture).empty());
}

TEST_F(Covered, AreNotThoseBehindTheSticksOwnOtherArm) {
  // Seen along the line from tip to tip, one arm is behind the other.
  marker().T_camera_marker.translation = {-40, 0, 450};
  marker().T_camera_marker.rotation = exp_so3({std::numbers::pi / 2, 0, 0}) * exp_so3({0, 0, std::numbers::pi / 4});
  see_all_but(0, cells() / 2);
  const auto front = covered.find(*record, picture).size();
  see_all_but(cells() / 2 + 1, cells());
  const auto back = covered.find(*record, picture).size();
  // Whichever is nearer is missed, the other one is not.
  EXPECT_LE(std::min(front, back), 2U);
  EXPECT_GE(std::max(front, back), 8U);
}

TEST_F(Covered, AreNotRingsThatPointAtTheCamera) {
  marker().T_camera_marker.rotation = exp_so3({0, std::numbers::pi / 2, 0});
  marker().T_camera_marker.translation = {0, 0, 450};
  see_all_but(cells() / 2 + 1, cells());
  EXPECT_TRUE(covered.find(*record, picture).empty());
}

}  // namespace
}  // namespace onestroke
