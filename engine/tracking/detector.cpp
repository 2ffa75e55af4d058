#include "tracking/detector.h"

#include "tracking/segmentation.h"

#include <algorithm>

namespace onestroke {

struct Detector::Row {
  std::vector<CellPoint> points;
  int low = 0, high = 0;  // Cells.
  int arm = -1;
  double middle = 0;  // Arc length of the points' mean.
  Vec2d origin, slope;
};

struct Detector::Hypothesis {
  int marker = 0;
  std::vector<CellPoint> points;
  std::vector<int> chains;
  std::vector<PoseGuess> guesses;
  double score = 0;
};

namespace {

constexpr int max_readings_per_marker = 60;
constexpr int max_proofs_per_marker = 8;
constexpr int min_pair_score = 10;

// Pixels per cell pitch along the points, roughly: the yardstick for reprojection errors.
double pitch_in_pixels(const Intrinsics& k, const RodModel& rod, const EigenPose& pose) {
  return k.fx * rod.pitch() / std::max(1.0, pose.t.z());
}

}  // namespace

bool believable(const RodModel& rod, const Refinement& r, const Appearance& a) {
  if (!r.valid || a.agrees < 9 || a.evidence() < 8) return false;
  // One arm alone leaves the roll about it to chance.
  if (rod.has_roll() && a.fewest_on_arm < 3) return false;
  // A marker in plain sight supports nearly every ring edge; a covered one still a good share of those whose cells
  // agree.
  return r.supported > 2.0 * a.agrees && r.supported > 0.25 * r.expected && r.rms < 2.0;
}

Detector::Detector(const Catalog& catalog) : catalog_(catalog) {
  for (const MarkerSpec& m : catalog.markers) rods_.emplace_back(m);
}

void Detector::find_rows(const ImageView& image, float blue_gain) {
  SegmentationOptions options;
  options.blue_gain = blue_gain;
  segment(image, options, labels_);
  cell_finder_.find(labels_, image.width, image.height, {}, cells_);
  chain_finder_.find(cells_, image.width, image.height, {}, chains_);
  readings_ = read_chains(catalog_, cells_, chains_);
}

void Detector::append_points(const Reading& r, std::vector<CellPoint>& points) const {
  const RodModel& rod = rods_[static_cast<std::size_t>(r.marker)];
  for (int i = r.begin; i < r.end; ++i) {
    const Chain::Link& l = chains_[static_cast<std::size_t>(r.chain)].links[static_cast<std::size_t>(i)];
    const Cell& cell = cells_[static_cast<std::size_t>(l.cell)];
    const int index = r.cell_of(l.position);
    if (index < 0 || index >= rod.cell_count() || rod.ink(index) != cell.ink) continue;
    points.push_back({index, cell.centre});
  }
}

// A reading as a line in the picture: pixel = origin + slope * arc length.
Detector::Row Detector::row_of(const Reading& r) const {
  Row row;
  append_points(r, row.points);
  const RodModel& rod = rods_[static_cast<std::size_t>(r.marker)];
  row.low = rod.cell_count();
  double n = 0, mean_s = 0;
  Vec2d mean = Vec2d::Zero();
  for (const CellPoint& p : row.points) {
    row.low = std::min(row.low, p.cell);
    row.high = std::max(row.high, p.cell);
    n += 1;
    mean_s += rod.middle(p.cell).s;
    mean += p.pixel;
  }
  mean_s /= n;
  mean /= n;
  double ss = 0;
  Vec2d sp = Vec2d::Zero();
  for (const CellPoint& p : row.points) {
    const double ds = rod.middle(p.cell).s - mean_s;
    ss += ds * ds;
    sp += ds * (p.pixel - mean);
  }
  row.slope = sp / std::max(ss, 1e-9);
  row.origin = mean - mean_s * row.slope;
  row.arm = rod.arm_of((row.low + row.high) / 2);
  row.middle = mean_s;
  return row;
}

// Two rows on neighbouring arms, prolonged, meet in the picture where the arms' axes do. Perspective bends the scale
// along an arm, so the tolerance grows with the distance prolonged.
bool Detector::meet(const RodModel& rod, const Row& a, const Row& b) {
  if (a.arm < 0 || b.arm < 0 || a.arm == b.arm) return false;
  if (std::abs(a.arm - b.arm) > 1) return true;
  const Row &first = a.arm < b.arm ? a : b, &second = a.arm < b.arm ? b : a;
  const RodModel::Meeting& m = rod.meeting(first.arm);
  const Vec2d p = first.origin + m.on_arm * first.slope, q = second.origin + m.on_next * second.slope;
  const double prolonged = std::abs(m.on_arm - first.middle) * first.slope.norm() +
                           std::abs(m.on_next - second.middle) * second.slope.norm();
  const double diameter = 2 * rod.radius() * std::max(first.slope.norm(), second.slope.norm());
  return (p - q).norm() < 0.25 * prolonged + diameter;
}

void Detector::propose_one(const Intrinsics& intrinsics, Hypothesis h, std::vector<Hypothesis>& hypotheses) const {
  const RodModel& rod = rods_[static_cast<std::size_t>(h.marker)];
  h.guesses = poses_from_cells(intrinsics, rod, h.points);
  if (h.guesses.empty()) return;
  const double limit = 0.35 * pitch_in_pixels(intrinsics, rod, h.guesses.front().pose) + 0.5;
  if (h.guesses.front().rms < limit) hypotheses.push_back(std::move(h));
}

void Detector::propose(const Intrinsics& intrinsics, const std::vector<bool>& skip,
                       std::vector<Hypothesis>& hypotheses) const {
  std::vector<std::vector<const Reading*>> by_marker(rods_.size());
  for (const Reading& r : readings_) {
    auto& list = by_marker[static_cast<std::size_t>(r.marker)];
    if (list.size() < max_readings_per_marker) list.push_back(&r);
  }
  for (std::size_t m = 0; m < rods_.size(); ++m) {
    if (!skip.empty() && skip[m]) continue;
    const RodModel& rod = rods_[m];
    const auto& list = by_marker[m];
    std::vector<Row> rows;
    for (const Reading* r : list) rows.push_back(row_of(*r));
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Row& a = rows[i];
      if (rod.arm_of(a.low) != rod.arm_of(a.high))
        propose_one(intrinsics, {static_cast<int>(m), a.points, {list[i]->chain}, {}, 1.0 * list[i]->score()},
                    hypotheses);
      for (std::size_t j = i + 1; j < list.size(); ++j) {
        const Row& b = rows[j];
        const int score = list[i]->score() + list[j]->score();
        if (score < min_pair_score || (a.low <= b.high && b.low <= a.high) || !meet(rod, a, b)) continue;
        if (list[i]->chain == list[j]->chain && list[i]->begin < list[j]->end && list[j]->begin < list[i]->end)
          continue;
        Hypothesis h{static_cast<int>(m), a.points, {list[i]->chain, list[j]->chain}, {}, 1.0 * score};
        h.points.insert(h.points.end(), b.points.begin(), b.points.end());
        propose_one(intrinsics, std::move(h), hypotheses);
      }
    }
  }
  std::stable_sort(hypotheses.begin(), hypotheses.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.score > b.score; });
}

Inks Detector::inks_of(const ImageView& image, const Hypothesis& h) const {
  InkSamples samples;
  for (const int chain : h.chains)
    for (const Chain::Link& l : chains_[static_cast<std::size_t>(chain)].links) {
      const Cell& c = cells_[static_cast<std::size_t>(l.cell)];
      if (image.contains(c.centre.x(), c.centre.y())) samples.add(c.ink, image.sample(c.centre.x(), c.centre.y()));
    }
  return samples.mean();
}

// Cheap look at a guess before the costly refinement.
void Detector::weigh(const ImageView& image, const Intrinsics& intrinsics, const Hypothesis& h,
                     std::vector<Candidate>& candidates) const {
  const RodModel& rod = rods_[static_cast<std::size_t>(h.marker)];
  const Inks seen = inks_of(image, h);
  if (seen.separation < 0.02F) return;
  for (const PoseGuess& g : h.guesses) {
    Candidate c{h.marker, g.pose, seen, 0};
    complete_inks(image, intrinsics, rod, g.pose, c.inks);
    const Appearance a = assess(image, intrinsics, rod, c.inks, g.pose);
    c.evidence = a.evidence();
    if (a.agrees >= 6 && 2 * a.contradicts <= a.agrees) candidates.push_back(c);
  }
}

bool Detector::prove(const ImageView& image, const Intrinsics& intrinsics, const Candidate& c,
                     Detection& detection) const {
  const RodModel& rod = rods_[static_cast<std::size_t>(c.marker)];
  const Refinement r = refine(image, intrinsics, rod, c.inks, c.pose);
  if (!r.valid) return false;
  Appearance a = assess(image, intrinsics, rod, c.inks, r.pose);
  if (!believable(rod, r, a)) return false;
  detection = {c.marker, r, std::move(a), c.inks};
  return true;
}

// Two detections explain the same cells of the picture.
bool Detector::overlap(const Intrinsics& intrinsics, const Detection& a, const Detection& b) const {
  const double reach = 0.5 * pitch_in_pixels(intrinsics, rod(a.marker), a.refinement.pose);
  int shared = 0;
  for (const CellCentre& p : a.appearance.cells)
    for (const CellCentre& q : b.appearance.cells)
      if (std::hypot(p.u - q.u, p.v - q.v) < reach) {
        ++shared;
        break;
      }
  return shared >= 3;
}

// Best first; a detection that explains again what a better one explains is dropped, and each marker exists once.
void Detector::select(const Intrinsics& intrinsics, std::vector<Detection>& proven,
                      std::vector<Detection>& detections) const {
  std::stable_sort(proven.begin(), proven.end(), [](const Detection& a, const Detection& b) {
    return a.refinement.supported + 4 * a.appearance.evidence() > b.refinement.supported + 4 * b.appearance.evidence();
  });
  for (Detection& d : proven) {
    const bool taken = std::any_of(detections.begin(), detections.end(), [&](const Detection& e) {
      return e.marker == d.marker || overlap(intrinsics, d, e);
    });
    if (!taken) detections.push_back(std::move(d));
  }
}

void Detector::detect(const ImageView& image, const Intrinsics& intrinsics, const std::vector<bool>& skip,
                      std::vector<Detection>& detections) {
  detections.clear();
  smooth(image, smoothed_);
  const ImageView soft{smoothed_.data(), image.width, image.height, 3 * static_cast<std::size_t>(image.width)};
  std::vector<Candidate> candidates;
  for (const float gain : {1.0F, 1.6F}) {
    find_rows(soft, gain);
    std::vector<Hypothesis> hypotheses;
    propose(intrinsics, skip, hypotheses);
    for (const Hypothesis& h : hypotheses) weigh(soft, intrinsics, h, candidates);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.evidence > b.evidence; });
  std::vector<Detection> proven;
  std::vector<int> tries(rods_.size(), 0);
  for (const Candidate& c : candidates) {
    if (++tries[static_cast<std::size_t>(c.marker)] > max_proofs_per_marker) continue;
    Detection d;
    if (prove(soft, intrinsics, c, d)) proven.push_back(std::move(d));
  }
  select(intrinsics, proven, detections);
}

}  // namespace onestroke
