#include "tracking/appearance.h"

#include "tracking/ink_matcher.h"
#include "tracking/placed_rod.h"
#include "tracking/sampling.h"

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

namespace onestroke {
namespace {

// Of the places across a cell where it is looked at, from the side that faces the eye: sines and cosines of 0.6
// radians.
constexpr std::array<double, 3> sines{-0.564642473395, 0, 0.564642473395};
constexpr std::array<double, 3> cosines{0.825335614910, 1, 0.825335614910};

// A surface seen at a flatter angle than this (cosine) shows gloss and what is behind.
constexpr double min_facing = 0.1;

// The middle of a cell's front in sight: its pixel, or false.
bool front_in_sight(const ImageView& image, const Intrinsics& k, const RodModel& rod, const EigenPose& pose,
                    const Vec3d& eye, int cell, Vec2d& pixel) {
  const RodModel::Section& m = rod.middle(cell);
  Vec3d out;
  const Vec3d x = rod.surface(m, eye, 0, &out);
  if (out.dot((eye - x).normalized()) < min_facing) return false;
  if (!project(k, pose * x, pixel) || !image.contains(pixel.x(), pixel.y())) return false;
  return !rod.hides_itself(m, x, eye);
}

}  // namespace

Appearance assess(const ImageView& image, const Intrinsics& intrinsics, const RodModel& rod, const Inks& inks,
                  const EigenPose& pose) {
  Appearance a;
  std::array<int, max_cells_per_marker> on_arm{}, arm_in_sight{};
  const PlacedRod placed(rod, pose);
  const InkMatcher matcher(inks);
  const Vec3d eye = -pose.R.transpose() * pose.t;
  for (int c = 0; c < rod.cell_count(); ++c) {
    const PlacedSection& here = placed.middle(c);
    const bool whole = rod.shows_whole(rod.middle(c), eye);
    int seen = 0, agrees = 0, contradicts = 0;
    Vec2d front = Vec2d::Zero();
    for (std::size_t i = 0; i < sines.size(); ++i) {
      const Vec3d out = here.out(sines[i], cosines[i]), x = here.surface(rod.radius(), out);
      Vec2d pixel;
      if (-out.dot(x) < min_facing * x.norm() || !project(intrinsics, x, pixel)) continue;
      if (!image.contains(pixel.x(), pixel.y())) continue;
      if (!whole && rod.hides_itself(rod.middle(c), pose.R.transpose() * (x - pose.t), eye)) continue;
      if (sines[i] == 0) front = pixel;
      ++seen;
      switch (matcher.match(sample_lanes(image, pixel.x(), pixel.y()), rod.ink(c))) {
        case Inks::Match::agrees:
          ++agrees;
          break;
        case Inks::Match::contradicts:
          ++contradicts;
          break;
        case Inks::Match::unknown:
          break;
      }
    }
    if (seen == 0) continue;
    ++a.in_sight;
    if (rod.arm_of(c) >= 0) ++arm_in_sight[static_cast<std::size_t>(rod.arm_of(c))];
    if (2 * agrees > seen) {
      ++a.agrees;
      if (rod.arm_of(c) >= 0) ++on_arm[static_cast<std::size_t>(rod.arm_of(c))];
      a.cells.push_back({c, front.x(), front.y()});
    } else if (2 * contradicts > seen) {
      ++a.contradicts;
    }
  }
  for (std::size_t i = 0; i < on_arm.size(); ++i)
    if (arm_in_sight[i] >= 4) a.weakest_share = std::min(a.weakest_share, 1.0 * on_arm[i] / arm_in_sight[i]);
  std::partial_sort(on_arm.begin(), on_arm.begin() + 2, on_arm.end(), std::greater<>());
  a.fewest_on_arm = on_arm[1];
  return a;
}

void complete_inks(const ImageView& image, const Intrinsics& intrinsics, const RodModel& rod, const EigenPose& pose,
                   Inks& inks) {
  const Vec3d eye = -pose.R.transpose() * pose.t;
  for (int ink = 0; ink < 3; ++ink) {
    if (inks.known[static_cast<std::size_t>(ink)]) continue;
    std::array<std::vector<float>, 3> samples;
    for (int c = 0; c < rod.cell_count(); ++c) {
      Vec2d pixel;
      if (rod.ink(c) != ink || !front_in_sight(image, intrinsics, rod, pose, eye, c, pixel)) continue;
      const Color chroma = chromaticity(image.sample(pixel.x(), pixel.y()));
      for (std::size_t i = 0; i < 3; ++i) samples[i].push_back(chroma[static_cast<int>(i)]);
    }
    if (samples[0].size() < 2) continue;
    Color median;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto middle = samples[i].begin() + static_cast<std::ptrdiff_t>(samples[i].size() / 2);
      std::nth_element(samples[i].begin(), middle, samples[i].end());
      median[static_cast<int>(i)] = *middle;
    }
    inks.set(ink, median);
  }
}

}  // namespace onestroke
