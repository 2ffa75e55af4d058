#include "tracking/likelihood.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace onestroke {
namespace {

// Something in front covers a run of cells: how often such a run begins and ends, from one cell to the next.
constexpr double cover_begins = 0.04, cover_ends = 0.15;
constexpr double worst_sample = -4;
// Gloss at a grazing angle adds the light's own colour: shares of it tried, and how common each is.
struct Veil {
  float share, prior;
};
constexpr std::array<Veil, 3> veils{{{0.0F, 0.7F}, {0.3F, 0.2F}, {0.6F, 0.1F}}};
// One lens and pixel blur edges by about this much, pixels.
constexpr double blur = 0.7;
// Fewer pixels than this are not worth a whole cell.
constexpr double pixels_per_cell = 12;
constexpr std::array<double, 3> angles{-0.7, 0.0, 0.7};

constexpr double usually_seen = cover_ends / (cover_begins + cover_ends);

double odds(double log_ratio) {
  return std::exp(std::min(log_ratio, 100.0));
}

// From one cell's probability to the next one's.
double next_seen(double seen) {
  return seen * (1 - cover_begins) + (1 - seen) * cover_ends;
}

float normal_cdf(double x) {
  return static_cast<float>(0.5 * std::erfc(-x * std::numbers::sqrt2 / 2));
}

class Scorer {
 public:
  Scorer(const ImageView& image, const Intrinsics& k, const RodModel& rod, const Inks& inks, const Surroundings& around,
         const EigenPose& pose)
      : image_(image), k_(k), rod_(rod), inks_(inks), around_(around), pose_(pose), eye_(-pose.R.transpose() * pose.t) {
    white_ = (inks.chroma[0] + inks.chroma[1] + inks.chroma[2]) / 3;
  }

  double cell(int c) const {
    double sum = 0;
    for (const double phi : angles) sum += patch(c, phi);
    return sum;
  }

  // An end disc, seen where the rod points at the camera.
  double disc(bool last) const {
    const RodModel::Section& tip = rod_.edge(last ? rod_.cell_count() : 0);
    const Vec3d out = last ? tip.tangent : Vec3d(-tip.tangent);
    const double facing = out.dot((eye_ - tip.centre).normalized());
    if (facing < 0.2) return 0;
    const int ink = rod_.ink(last ? rod_.cell_count() - 1 : 0);
    const double scale = k_.fx / std::max(1.0, (pose_ * tip.centre).z());
    const double area = std::numbers::pi * rod_.radius() * rod_.radius() * facing * scale * scale;
    const Vec3d u = tip.tangent.unitOrthogonal(), v = tip.tangent.cross(u);
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
      const double a = i * std::numbers::pi / 2;
      const Vec3d x = tip.centre + 0.55 * rod_.radius() * (std::cos(a) * u + std::sin(a) * v);
      Vec2d pixel;
      if (!project(k_, pose_ * x, pixel) || !image_.contains(pixel.x(), pixel.y())) continue;
      if (rod_.hides_itself(tip, x + 0.05 * out, eye_)) continue;
      sum += std::min(1.0, area / pixels_per_cell) / 4 * ratio(inks_.chroma[static_cast<std::size_t>(ink)], pixel);
    }
    return sum;
  }

 private:
  double patch(int c, double phi) const {
    const RodModel::Section& m = rod_.middle(c);
    Vec3d out;
    const Vec3d x = rod_.surface(m, eye_, phi, &out);
    const double facing = out.dot((eye_ - x).normalized());
    if (facing < 0.1) return 0;
    Vec2d pixel, before, after;
    if (!project(k_, pose_ * x, pixel) || !image_.contains(pixel.x(), pixel.y())) return 0;
    if (rod_.hides_itself(m, x, eye_)) return 0;
    if (!project(k_, pose_ * (x - m.tangent), before) || !project(k_, pose_ * (x + m.tangent), after)) return 0;
    const double along = (after - before).norm() / 2;  // Pixels a millimetre.
    const double scale = k_.fx / (pose_ * x).z();
    const double area = along * rod_.pitch() * 2 * rod_.radius() * scale;
    return std::min(1.0, area / pixels_per_cell) / static_cast<double>(angles.size()) *
           ratio(mixed(m.s, blur / std::max(along, 1e-3)), pixel);
  }

  // The chromaticity that rings show at an arc length, blurred by sigma millimetres along the rod.
  Color mixed(double s, double sigma) const {
    const int c0 = std::max(0, static_cast<int>((s - 2.5 * sigma) / rod_.pitch()));
    const int c1 = std::min(rod_.cell_count() - 1, static_cast<int>((s + 2.5 * sigma) / rod_.pitch()));
    if (c0 >= c1 || sigma < 0.15 * rod_.pitch())
      return inks_.chroma[static_cast<std::size_t>(
          rod_.ink(std::clamp(static_cast<int>(s / rod_.pitch()), 0, rod_.cell_count() - 1)))];
    Color sum = Color::Zero();
    float weight = 0, below = normal_cdf((c0 * rod_.pitch() - s) / sigma);
    for (int c = c0; c <= c1; ++c) {
      const float above = normal_cdf(((c + 1) * rod_.pitch() - s) / sigma);
      sum += (above - below) * inks_.chroma[static_cast<std::size_t>(rod_.ink(c))];
      weight += above - below;
      below = above;
    }
    return sum / std::max(weight, 1e-6F);
  }

  double ratio(const Color& expected, const Vec2d& pixel) const {
    const Color color = image_.sample(pixel.x(), pixel.y());
    // What is as good as black has no colour to tell.
    if (color.sum() < 12) return 0;
    const Color chroma = chromaticity(color);
    const float variance = inks_.variance(2.5F / color.sum());
    float shown = 0;
    for (const Veil& v : veils)
      shown += v.prior * chroma_density(chroma - ((1 - v.share) * expected + v.share * white_), variance);
    return log_ratio(shown, around_.density(chroma));
  }

  const ImageView& image_;
  const Intrinsics& k_;
  const RodModel& rod_;
  const Inks& inks_;
  const Surroundings& around_;
  const EigenPose& pose_;
  Vec3d eye_;  // Marker frame.
  Color white_;
};

}  // namespace

Surroundings::Surroundings(const ImageView& image, const Intrinsics& k, const RodModel& rod, const EigenPose& pose) {
  // Every other one of a few ten thousand pixels tells the colours as well as all.
  constexpr int samples = 96;
  Vec2d middle;
  density_.fill(1);
  const Vec3d centre = pose * rod.centre();
  if (!project(k, centre, middle)) return;
  pixels_per_mm_ = k.fx / centre.z();
  const double reach = 1.2 * rod.bounding_radius() * pixels_per_mm_;
  std::array<float, bins * bins> count{};
  float n = 0;
  for (int i = 0; i < samples; ++i)
    for (int j = 0; j < samples; ++j) {
      const double u = middle.x() + reach * (2.0 * i / (samples - 1) - 1);
      const double v = middle.y() + reach * (2.0 * j / (samples - 1) - 1);
      if (!image.contains(u, v)) continue;
      const std::uint8_t* p = image.at(static_cast<int>(u), static_cast<int>(v));
      const Color c = chromaticity({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
      const int x = std::min(bins - 1, static_cast<int>(c[0] * bins)),
                y = std::min(bins - 1, static_cast<int>(c[1] * bins));
      ++count[static_cast<std::size_t>(y * bins + x)];
      ++n;
    }
  // Smoothed by (1 2 1) both ways; a tenth may be any colour.
  constexpr std::array<float, 3> kernel{0.25F, 0.5F, 0.25F};
  const float per_bin = 0.9F * bins * bins / std::max(n, 1.0F);
  for (int y = 0; y < bins; ++y)
    for (int x = 0; x < bins; ++x) {
      float sum = 0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int yy = std::clamp(y + dy, 0, bins - 1), xx = std::clamp(x + dx, 0, bins - 1);
          sum += kernel[static_cast<std::size_t>(dy + 1)] * kernel[static_cast<std::size_t>(dx + 1)] *
                 count[static_cast<std::size_t>(yy * bins + xx)];
        }
      density_[static_cast<std::size_t>(y * bins + x)] = per_bin * sum + 0.1F * 2;
    }
}

float Surroundings::density(const Color& chroma) const {
  const int x = std::clamp(static_cast<int>(chroma[0] * bins), 0, bins - 1);
  const int y = std::clamp(static_cast<int>(chroma[1] * bins), 0, bins - 1);
  return density_[static_cast<std::size_t>(y * bins + x)];
}

double log_ratio(float as_rod, float otherwise) {
  return std::max(worst_sample, static_cast<double>(std::log(as_rod / otherwise + 1e-9F)));
}

float chroma_density(const Color& d, float variance) {
  return std::exp(-0.5F * (d[0] * d[0] + d[1] * d[1]) / variance) / (2 * std::numbers::pi_v<float> * variance);
}

double LikelihoodMeter::operator()(const EigenPose& pose) const {
  const Scorer scorer(image_, k_, rod_, inks_, surroundings_, pose);
  std::array<double, max_cells> shows{};
  const int n = rod_.cell_count();
  for (int c = 0; c < n; ++c) shows[static_cast<std::size_t>(c)] = scorer.cell(c);
  shows[0] += scorer.disc(false);
  shows[static_cast<std::size_t>(n - 1)] += scorer.disc(true);
  return visible_or_covered({shows.data(), static_cast<std::size_t>(n)});
}

double visible_or_covered(std::span<const double> log_ratios) {
  double seen = usually_seen, sum = 0;
  for (const double ratio : log_ratios) {
    const double shown = seen * odds(ratio), total = shown + 1 - seen;
    sum += std::log(total);
    seen = next_seen(shown / total);
  }
  return sum;
}

// The chain is reversible, so that what comes after a cell tells of it as what came before does.
void visible_probabilities(std::span<const double> log_ratios, std::span<double> seen) {
  double before = usually_seen, after = usually_seen;
  for (std::size_t i = 0; i < log_ratios.size(); ++i) {
    const double shown = before * odds(log_ratios[i]);
    seen[i] = shown / (shown + 1 - before);
    before = next_seen(seen[i]);
  }
  for (std::size_t i = log_ratios.size(); i-- > 0;) {
    // Each side's prediction holds the chain's own mean once; it counts once in all.
    const double both = seen[i] * after * (1 - usually_seen);
    const double shown = after * odds(log_ratios[i]);
    seen[i] = both / (both + (1 - seen[i]) * (1 - after) * usually_seen);
    after = next_seen(shown / (shown + 1 - after));
  }
}

}  // namespace onestroke
