// `onestroke track` in the guest, before the played camera: its poses are those that it finds here in the files that
// are played, and near the truth.
#include "core/pose.h"
#include "guest_run.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <map>
#include <numbers>

namespace onestroke {
namespace {

using nlohmann::json;

const std::string track = ONESTROKE_PROGRAM " track --catalog " ONESTROKE_SOURCE_DIR "/assets/catalog.json --fov 35 ";

struct Place {
  std::array<std::array<double, 3>, 3> R;
  std::array<double, 3> t;
};

/// By the picture's number and the marker's id.
using Places = std::map<std::pair<int, int>, Place>;

Place place_of(const json& marker) {
  return {marker["R"].get<decltype(Place::R)>(), marker["t"].get<decltype(Place::t)>()};
}

/// "0012", "0012.jpg" and "frame_000012" are 12.
int number_of(const json& picture) {
  const std::string name = picture;
  return std::stoi(name.substr(name.find_first_of("0123456789")));
}

Places places_of(const std::vector<json>& lines) {
  Places places;
  for (const json& line : lines)
    for (const json& marker : line["markers"])
      if (marker.value("state", "measured") == "measured")
        places[{number_of(line["image"]), marker["id"]}] = place_of(marker);
  return places;
}

double degrees_between(const Place& a, const Place& b) {
  double trace = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) trace += a.R[i][j] * b.R[i][j];
  return std::acos(std::clamp((trace - 1) / 2, -1., 1.)) * 180 / std::numbers::pi;
}

double mm_between(const Place& a, const Place& b) {
  return std::hypot(a.t[0] - b.t[0], a.t[1] - b.t[1], a.t[2] - b.t[2]);
}

struct Difference {
  std::vector<double> degrees, mm;
};

double share_of(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::infinity();
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// Of all that both have.
Difference difference(const Places& some, const Places& others) {
  Difference d;
  for (const auto& [which, place] : some) {
    const auto other = others.find(which);
    if (other == others.end()) continue;
    d.degrees.push_back(degrees_between(place, other->second));
    d.mm.push_back(mm_between(place, other->second));
  }
  return d;
}

void say(const char* what, const Difference& d) {
  std::cout << what << ", " << d.mm.size() << " poses: degrees, median " << share_of(d.degrees, 0.5)
            << ", 95 of 100 within " << share_of(d.degrees, 0.95) << "; mm, median " << share_of(d.mm, 0.5)
            << ", 95 of 100 within " << share_of(d.mm, 0.95) << '\n';
}

Places truth() {
  return places_of(read_lines(std::string(CAMERA_PLAYED) + "/truth.jsonl"));
}

Places tracked_here() {
  const std::filesystem::path file = std::filesystem::path(CAMERA_LOGS) / "tracked_here.jsonl";
  std::filesystem::create_directories(CAMERA_LOGS);
  const std::string command = track + "--camera folder:" CAMERA_PLAYED "/mjpeg --output " + file.string();
  EXPECT_EQ(std::system(command.c_str()), 0);
  return places_of(read_lines(file));
}

// As many as the emulated processor has time for, of three times as many that are played.
constexpr std::size_t asked = 100;

/// A picture may be left out, and its pose then is not among these.
Places tracked_in_guest(const std::string& name, const std::string& format) {
  const GuestRun run = run_in_guest(name, "--rate 8 --format " + format,
                                    "sh -c '" + track + "--camera libcamera --frames " + std::to_string(asked) +
                                        " --output $CAMERA_RESULTS/poses.jsonl'");
  EXPECT_EQ(run.code, 0) << run.output;
  const Places places = places_of(read_lines(run.results / "poses.jsonl"));
  EXPECT_EQ(places.size(), asked);
  return places;
}

/// The tracker follows, and here it sees all pictures, so that the poses are not the same to the last bit.
void expect_alike(const Difference& d) {
  EXPECT_GE(d.mm.size(), asked);
  EXPECT_LT(share_of(d.degrees, 0.5), 0.3);
  EXPECT_LT(share_of(d.mm, 0.5), 0.1);
  EXPECT_LT(share_of(d.degrees, 0.95), 1.5);
  EXPECT_LT(share_of(d.mm, 0.95), 0.5);
}

void expect_true(const Difference& d) {
  EXPECT_GE(d.mm.size(), asked);
  EXPECT_LT(share_of(d.degrees, 0.5), 0.6);
  EXPECT_LT(share_of(d.mm, 0.5), 0.3);
}

TEST(GuestTrack, FindsInJpegsWhatItFindsInTheirFiles) {
  const Places in_guest = tracked_in_guest("TrackJpegs", "MJPG:640x480:" CAMERA_PLAYED "/mjpeg");
  const Difference to_here = difference(in_guest, tracked_here()), to_truth = difference(in_guest, truth());
  say("to what is found here", to_here);
  say("to the truth", to_truth);
  expect_alike(to_here);
  expect_true(to_truth);
}

TEST(GuestTrack, FindsInYuyvPicturesWhatIsTrue) {
  const Places in_guest = tracked_in_guest("TrackYuyv", "YUYV:640x480:" CAMERA_PLAYED "/yuyv");
  const Difference to_truth = difference(in_guest, truth());
  say("to the truth", to_truth);
  expect_true(to_truth);
}

}  // namespace
}  // namespace onestroke
