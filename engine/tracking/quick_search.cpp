#include "tracking/quick_search.h"

#include "tracking/segmentation.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace onestroke {
namespace {

// Columns that are looked at coarsely, about.
constexpr int columns = 400;
// Of a row that proposes a pose, and of one that makes a thorough search worth its time.
constexpr int min_links = 6;
// How far an ink's channel leads the second: first more than most backgrounds' do, as those run into rings of the ink
// that they are nearest to; then as little as an ink's may in shade, fog or lamplight.
constexpr std::array<float, 2> margins{0.3F, SegmentationOptions{}.relative_margin};
// Proposals of one marker that are put to the proof.
constexpr int max_tries = 3;

}  // namespace

void QuickSearch::look(const TimedView& view, Detail detail, float margin) {
  factor_ = std::max(1, view.image.width / columns / (detail == Detail::fine ? 2 : 1));
  segment(view.image, {.relative_margin = margin}, labels_, factor_);
  const int width = view.image.width / factor_, height = view.image.height / factor_;
  cell_finder_.find(labels_, width, height, {}, cells_);
  chain_finder_.find(cells_, width, height, {.min_cells = min_links}, chains_);
  reader_.read(cells_, chains_, readings_);
}

void QuickSearch::find(const TimedView& view, Detail detail, const std::vector<bool>& skip,
                       const std::vector<Detection>& known, std::vector<Detection>& found) {
  const std::size_t before = found.size();
  for (const float margin : margins) {
    look(view, detail, margin);
    explained_.assign(chains_.size(), false);
    note_explained(known);
    propose(view, skip, before, found);
    if (!chains_.empty() && std::find(explained_.begin(), explained_.end(), false) == explained_.end()) break;
  }
  unexplained_.clear();
  for (std::size_t c = 0; c < chains_.size(); ++c) {
    if (explained_[c]) continue;
    const Chain& chain = chains_[c];
    const Cell& middle = cells_[static_cast<std::size_t>(chain.links[chain.links.size() / 2].cell)];
    unexplained_.emplace_back(factor_ * middle.centre);
  }
}

// The best readings first: those that they explain need not be tried.
void QuickSearch::propose(const TimedView& view, const std::vector<bool>& skip, std::size_t before,
                          std::vector<Detection>& found) {
  Intrinsics small = view.intrinsics;
  small.fx /= factor_;
  small.fy /= factor_;
  // The pixel looked at stands for its square: at its middle, or half a pixel beside it.
  const double shift = factor_ % 2 ? 0 : 0.5 / factor_;
  small.cx = small.cx / factor_ - shift;
  small.cy = small.cy / factor_ - shift;
  pairs_.clear();
  proposer_.find(skip, pairs_);
  std::sort(pairs_.begin(), pairs_.end(), [](const ReadingPair& a, const ReadingPair& b) {
    return std::tuple(-a.score, a.marker, a.first, a.second) < std::tuple(-b.score, b.marker, b.first, b.second);
  });
  tries_.assign(rods_.size(), 0);
  const std::span<const Detection> already(found.begin() + static_cast<std::ptrdiff_t>(before), found.end());
  note_explained(already);
  for (const Detection& d : already) tries_[static_cast<std::size_t>(d.marker)] = max_tries;
  const auto taken = [&](int reading) {
    return reading >= 0 && explained_[static_cast<std::size_t>(readings_[static_cast<std::size_t>(reading)].chain)];
  };
  for (const ReadingPair& pair : pairs_) {
    int& tries = tries_[static_cast<std::size_t>(pair.marker)];
    if (tries >= max_tries || taken(pair.first) || taken(pair.second)) continue;
    Detection d;
    if (!prove(view, small, pair, d)) continue;
    tries = max_tries;
    found.push_back(d);
    note_explained({&found.back(), 1});
  }
}

bool QuickSearch::prove(const TimedView& view, const Intrinsics& small, const ReadingPair& pair, Detection& detection) {
  const RodModel& rod = rods_[static_cast<std::size_t>(pair.marker)];
  proposer_.points_of(pair, points_);
  const auto guesses = poses_in_weak_perspective(small, rod, points_);
  if (guesses.empty() || guesses.front().rms >= Proposer::max_rms(small, rod, guesses.front().pose)) return false;
  ++tries_[static_cast<std::size_t>(pair.marker)];
  const Inks inks = inks_of(view.image, rod, points_, factor_);
  if (inks.separation < min_ink_separation || !(inks.known[0] && inks.known[1] && inks.known[2])) return false;
  for (const PoseGuess& g : guesses)
    if (lines_.prove(view, pair.marker, rod, {.pose = g.pose}, {}, inks, detection)) return true;
  return false;
}

void QuickSearch::note_explained(std::span<const Detection> detections) {
  for (std::size_t c = 0; c < chains_.size(); ++c)
    for (const Detection& d : detections)
      if (!explained_[c]) explained_[c] = explained(chains_[c], d);
}

// Most of its cells are those of a detection.
bool QuickSearch::explained(const Chain& chain, const Detection& d) const {
  std::size_t known = 0;
  const double reach = chain.width * factor_;
  for (const Chain::Link& l : chain.links) {
    const Vec2d p = factor_ * cells_[static_cast<std::size_t>(l.cell)].centre;
    known += std::any_of(d.appearance.cells.begin(), d.appearance.cells.end(),
                         [&](const CellCentre& c) { return (p - Vec2d(c.u, c.v)).squaredNorm() < reach * reach; });
  }
  return 2 * known >= chain.links.size();
}

}  // namespace onestroke
