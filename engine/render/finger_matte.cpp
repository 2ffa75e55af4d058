#include "render/finger_matte.h"

#include <algorithm>
#include <cmath>

namespace onestroke {

namespace {

// A finger's front is so far before the middle of the ring that it covers, mm.
constexpr double thickness = 12;
// Of logarithms: what skin varies by at the least, and what still belongs to it in spreads.
constexpr float least_spread = 0.10F, within = 2.6F;
// Brightness between neighbours in one finger, coded.
constexpr float largest_step = 0.16F;

struct Chroma {
  float red, blue;
};

Chroma chroma_of(const Rgb& coded) {
  const Rgb linear = linear_of(coded);
  constexpr float floor = 0.002F;
  const float green = std::log(linear[1] + floor);
  return {std::log(linear[0] + floor) - green, std::log(linear[2] + floor) - green};
}

}  // namespace

bool may_be_skin(const Rgb& coded) {
  const auto [red, blue] = chroma_of(coded);
  return coded[0] > 0.08F && red > 0.12F && red < 1.6F && blue > -1.6F && blue < 0.25F;
}

bool FingerMatte::Skin::like(const Rgb& coded) const {
  const auto [r, b] = chroma_of(coded);
  const float dr = (r - red) / red_spread, db = (b - blue) / blue_spread;
  return coded[1] > darkest && dr * dr + db * db < within * within && may_be_skin(coded);
}

Rgb FingerMatte::mean_color(const Picture& p, Place texel) const {
  const int x0 = texel.x * scale_, y0 = texel.y * scale_;
  Rgb sum{};
  constexpr int across = 2;
  for (int i = 0; i < across * across; ++i) {
    const int x = std::min(x0 + (2 * (i % across) + 1) * scale_ / (2 * across), p.width - 1);
    const int y = std::min(y0 + (2 * (i / across) + 1) * scale_ / (2 * across), p.height - 1);
    const Rgb c = coded_at(p, x, y);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += c[k] / (across * across);
  }
  return sum;
}

bool FingerMatte::learn(const Picture& p, std::span<const CoveredCell> cells, Skin& skin) {
  seed_count_ = 0;
  std::array<Rgb, 64> colors;
  float red = 0, blue = 0;
  for (const CoveredCell& cell : cells) {
    if (cell.at.z <= 0 || seed_count_ == seeds_.size()) continue;
    const double u = p.intrinsics.fx * cell.at.x / cell.at.z + p.intrinsics.cx;
    const double v = p.intrinsics.fy * cell.at.y / cell.at.z + p.intrinsics.cy;
    if (!(u >= 0 && v >= 0 && u < p.width && v < p.height)) continue;
    const Place place{static_cast<int>(u) / scale_, static_cast<int>(v) / scale_};
    const Rgb color = mean_color(p, place);
    if (!may_be_skin(color)) continue;
    colors[seed_count_] = color;
    seeds_[seed_count_++] = place;
    red += chroma_of(color).red;
    blue += chroma_of(color).blue;
  }
  // One alone may be glare.
  if (seed_count_ < 2) return false;
  const auto n = static_cast<float>(seed_count_);
  skin = {.red = red / n, .blue = blue / n, .red_spread = 0, .blue_spread = 0, .darkest = 1};
  for (std::size_t i = 0; i < seed_count_; ++i) {
    const auto [r, b] = chroma_of(colors[i]);
    skin.red_spread += (r - skin.red) * (r - skin.red) / n;
    skin.blue_spread += (b - skin.blue) * (b - skin.blue) / n;
    skin.darkest = std::min(skin.darkest, 0.5F * colors[i][1]);
  }
  skin.red_spread = std::max(std::sqrt(skin.red_spread), least_spread);
  skin.blue_spread = std::max(std::sqrt(skin.blue_spread), least_spread);
  return true;
}

void FingerMatte::grow(const Picture& p, const Skin& skin, double reach_px) {
  const auto at = [](Place t) { return static_cast<std::size_t>(t.y * side + t.x); };
  const double reach2 = reach_px * reach_px / (scale_ * scale_);
  const auto near = [&](Place t) {
    return std::any_of(seeds_.begin(), seeds_.begin() + static_cast<std::ptrdiff_t>(seed_count_),
                       [&](Place s) { return (s.x - t.x) * (s.x - t.x) + (s.y - t.y) * (s.y - t.y) <= reach2; });
  };
  queued_ = 0;
  const auto take = [&](Place t) {
    grown_[at(t)] = 255;
    queue_[queued_++] = t;
  };
  for (std::size_t i = 0; i < seed_count_; ++i)
    if (grown_[at(seeds_[i])] == 0) take(seeds_[i]);
  for (std::size_t next = 0; next < queued_; ++next) {
    const Place t = queue_[next];
    const float here = mean_color(p, t)[1];
    constexpr std::array<Place, 4> sides{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    for (const Place step : sides) {
      const Place n{t.x + step.x, t.y + step.y};
      if (n.x < 0 || n.y < 0 || n.x >= width_ || n.y >= height_ || grown_[at(n)] || !near(n)) continue;
      const Rgb color = mean_color(p, n);
      if (skin.like(color) && std::abs(color[1] - here) < largest_step) take(n);
    }
  }
}

// A mean over three by three, so that the edge is not one of texels.
void FingerMatte::soften() {
  alpha_.fill(0);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      int sum = 0;
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j) {
          const int row = std::clamp(y + i, 0, height_ - 1), column = std::clamp(x + j, 0, width_ - 1);
          sum += grown_[static_cast<std::size_t>(row * side + column)];
        }
      alpha_[static_cast<std::size_t>(y * side + x)] = static_cast<std::uint8_t>(sum / 9);
    }
}

void FingerMatte::find(const Picture& p, std::span<const CoveredCell> cells) {
  count_ = 0;
  scale_ = std::max(1, (std::max(p.width, p.height) + side - 1) / side);
  width_ = (p.width + scale_ - 1) / scale_;
  height_ = (p.height + scale_ - 1) / scale_;
  if (cells.empty()) return;
  grown_.fill(0);
  while (!cells.empty() && count_ < most_fingers) {
    const auto end =
        std::find_if(cells.begin(), cells.end(), [&](const CoveredCell& c) { return c.stick != cells.front().stick; });
    const auto own = cells.first(static_cast<std::size_t>(end - cells.begin()));
    cells = cells.subspan(own.size());
    Skin skin;
    if (!learn(p, own, skin)) continue;
    double depth = 0;
    for (const CoveredCell& c : own) depth += c.at.z / static_cast<double>(own.size());
    grow(p, skin, p.intrinsics.fx * reach / depth);
    if (queued_ == 0) continue;  // all of it belongs to the fingers on another stick
    Finger finger{1e9, 1e9, -1e9, -1e9, depth - thickness};
    for (const Place t : std::span(queue_).first(queued_)) {
      finger.left = std::min(finger.left, scale_ * 1.0 * (t.x - 1));
      finger.top = std::min(finger.top, scale_ * 1.0 * (t.y - 1));
      finger.right = std::max(finger.right, scale_ * 1.0 * (t.x + 2));
      finger.bottom = std::max(finger.bottom, scale_ * 1.0 * (t.y + 2));
    }
    fingers_[count_++] = finger;
  }
  if (count_ > 0) soften();
}

}  // namespace onestroke
