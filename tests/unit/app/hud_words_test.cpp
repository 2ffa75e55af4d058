#include "app/hud_words.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace onestroke {
namespace {

void add(FrameRecord& record, const std::string& name, MarkerState state, int cells, Vec3 at) {
  MarkerObservation& m = record.markers[static_cast<std::size_t>(record.marker_count++)];
  std::copy(name.begin(), name.end(), m.name.begin());
  m.id = record.marker_count;
  m.state = state;
  m.cells_seen = cells;
  m.T_camera_marker.translation = at;
}

std::vector<std::string> lines_of(const HudWords& words) {
  std::vector<std::string> lines;
  for (const Text& line : words.figures()) lines.emplace_back(line.view());
  return lines;
}

std::string row(const HudWords::Marker& m) {
  return std::string(m.name.view()) + "|" + std::string(m.state.view()) + "|" + std::string(m.cells.view()) + "|" +
         std::string(m.distance.view());
}

const FrameFigures figures{
    .tracker_ms = 8.25,
    .pictures_a_second = 29.8,
    .frames_a_second = 60.1,
    .latency = Latency{Duration::from_ms(11.4), Duration::from_ms(15.2), Duration::from_ms(23.4)},
    .left_out = 3};

TEST(HudWords, CountTheCellsOfEachEye) {
  FrameRecord record;
  add(record, "both", MarkerState::measured, 31, {0, 0, 500});
  add(record, "right eye's", MarkerState::measured, 0, {0, 0, 300});
  record.markers[0].second_cells = 0xffff;
  record.markers[1].second_cells = 0b1011;
  HudWords words(true);
  words.update(record, figures);
  EXPECT_EQ(row(words.markers()[0]), "both|measured|31 + 16 cells|500 mm");
  EXPECT_EQ(row(words.markers()[1]), "right eye's|measured|0 + 3 cells|300 mm");
}

TEST(HudWords, SayARowAMarker) {
  FrameRecord record;
  add(record, "bracket v1", MarkerState::measured, 31, {30, 40, 500});
  add(record, "bracket v2", MarkerState::predicted, 0, {0, 0, 300});
  add(record, "third", MarkerState::lost, 0, {0, 0, 300});
  HudWords words(true);
  words.update(record, figures);
  ASSERT_EQ(words.markers().size(), 3u);
  EXPECT_EQ(row(words.markers()[0]), "bracket v1|measured|31 cells|502 mm");
  EXPECT_EQ(row(words.markers()[1]), "bracket v2|predicted|0 cells|300 mm");
  EXPECT_EQ(row(words.markers()[2]), "third|lost||") << "where it was says nothing of where it is";
  EXPECT_EQ(words.markers()[0].kind, MarkerState::measured);
  EXPECT_EQ(words.markers()[2].kind, MarkerState::lost);
  record.marker_count = 0;
  words.update(record, figures);
  EXPECT_TRUE(words.markers().empty());
}

TEST(HudWords, KeepTheRowsInTheOrderOfTheirIds) {
  FrameRecord record;
  for (const char* name : {"one", "two", "three"}) add(record, name, MarkerState::measured, 30, {0, 0, 400});
  std::swap(record.markers[0], record.markers[2]);
  HudWords words(true);
  words.update(record, figures);
  for (std::size_t i = 0; const char* name : {"one", "two", "three"}) EXPECT_EQ(words.markers()[i++].name.view(), name);
}

TEST(HudWords, SayHowTheShowGoes) {
  HudWords words(true);
  words.update({}, figures);
  EXPECT_EQ(lines_of(words),
            (std::vector<std::string>{"30 pictures/s · 60 frames/s · 3 left out", "Tracker 8.2 ms a picture",
                                      "After exposure: tracked 11, drawn 15, seen 23 ms"}));
  EXPECT_EQ(words.status(),
            "30 pictures/s · 60 frames/s · 3 left out\nTracker 8.2 ms a picture\n"
            "After exposure: tracked 11, drawn 15, seen 23 ms");
  FrameFigures recording = figures;
  recording.latency.reset();
  words.update({}, recording);
  EXPECT_EQ(lines_of(words),
            (std::vector<std::string>{"30 pictures/s · 60 frames/s · 3 left out", "Tracker 8.2 ms a picture"}));
  HudWords film(false);
  film.update({}, figures);
  EXPECT_EQ(film.status(), "Tracker 8.2 ms a picture");
}

TEST(HudWords, LeaveOutWhatDependsOnTheMachine) {
  HudWords words(false);
  words.update({}, figures);
  EXPECT_EQ(lines_of(words), std::vector<std::string>{"Tracker 8.2 ms a picture"});
}

TEST(HudWords, HaveRoomForEveryMarkerOfARecord) {
  FrameRecord record;
  for (int i = 0; i < max_markers_per_frame; ++i)
    add(record, std::string(max_name_length, 'W'), MarkerState::measured, max_cells_per_marker, {0, 0, 1e6});
  HudWords words(true);
  words.update(record, figures);
  ASSERT_EQ(words.markers().size(), std::size_t{max_markers_per_frame});
  EXPECT_EQ(row(words.markers().back()), std::string(max_name_length, 'W') + "|measured|64 cells|1000000 mm");
}

}  // namespace
}  // namespace onestroke
