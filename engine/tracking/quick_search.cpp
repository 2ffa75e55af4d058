#include "tracking/quick_search.h"

#include "tracking/segmentation.h"

#include <algorithm>
#include <cmath>

namespace onestroke {
namespace {

// Columns that are looked at, about.
constexpr int columns = 400;
// Of a row that proposes a pose, and of one that makes a thorough search worth its time.
constexpr std::size_t min_links = 6;
// Proposals of one marker that are put to the proof.
constexpr int max_tries = 3;

}  // namespace

void QuickSearch::propose(const TimedView& view, const std::vector<bool>& skip) {
  factor_ = std::max(1, view.image.width / columns);
  segment(view.image, {}, labels_, factor_);
  const int width = view.image.width / factor_, height = view.image.height / factor_;
  cell_finder_.find(labels_, width, height, {}, cells_);
  chain_finder_.find(cells_, width, height, {}, chains_);
  std::erase_if(chains_, [](const Chain& c) { return c.links.size() < min_links; });
  readings_ = read_chains(catalog_, windows_, cells_, chains_);
  Intrinsics small = view.intrinsics;
  small.fx /= factor_;
  small.fy /= factor_;
  // The pixel looked at stands for its square: at its middle, or half a pixel beside it.
  const double shift = factor_ % 2 ? 0 : 0.5 / factor_;
  small.cx = small.cx / factor_ - shift;
  small.cy = small.cy / factor_ - shift;
  proposals_.clear();
  Proposer(rods_, cells_, chains_, readings_, {}).pairs(small, skip, proposals_);
  std::stable_sort(proposals_.begin(), proposals_.end(),
                   [](const Proposal& a, const Proposal& b) { return a.score > b.score; });
}

void QuickSearch::find(const TimedView& view, const std::vector<bool>& skip, const std::vector<Detection>& known,
                       std::vector<Detection>& found) {
  propose(view, skip);
  std::vector<int> tries(rods_.size(), 0);
  for (const Proposal& p : proposals_) {
    const auto m = static_cast<std::size_t>(p.marker);
    if (tries[m]++ >= max_tries) continue;
    const RodModel& rod = rods_[m];
    const Inks inks = inks_of(view.image, rod, p, factor_);
    if (inks.separation < min_ink_separation || !(inks.known[0] && inks.known[1] && inks.known[2])) continue;
    for (const PoseGuess& g : p.guesses) {
      Detection d;
      if (!lines_.prove(view, p.marker, rod, {.pose = g.pose}, {}, inks, d)) continue;
      tries[m] = max_tries;
      found.push_back(std::move(d));
      break;
    }
  }
  unexplained_.clear();
  for (const Chain& c : chains_)
    if (!explained(c, known) && !explained(c, found))
      unexplained_.emplace_back(factor_ * cells_[static_cast<std::size_t>(c.links[c.links.size() / 2].cell)].centre);
}

// Most of its cells are those of a detection.
bool QuickSearch::explained(const Chain& chain, const std::vector<Detection>& detections) const {
  std::size_t known = 0;
  for (const Chain::Link& l : chain.links) {
    const Vec2d p = factor_ * cells_[static_cast<std::size_t>(l.cell)].centre;
    known += std::any_of(detections.begin(), detections.end(), [&](const Detection& d) {
      return std::any_of(d.appearance.cells.begin(), d.appearance.cells.end(), [&](const CellCentre& c) {
        return std::hypot(p.x() - c.u, p.y() - c.v) < chain.width * factor_;
      });
    });
  }
  return 2 * known >= chain.links.size();
}

}  // namespace onestroke
