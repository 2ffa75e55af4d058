#include "camera/synthetic_renderer.h"

#include "camera/row_painter.h"
#include "camera/row_workers.h"
#include "camera/sensor.h"
#include "camera/softening.h"

#include <algorithm>
#include <cmath>

namespace onestroke {

struct SyntheticRenderer::State {
  explicit State(int threads) : workers(threads), painters(static_cast<std::size_t>(threads)) {}

  void paint_rows(int worker);
  void develop_softened(int worker);
  void count_cells(std::span<int> cells_visible) const;

  RowWorkers workers;
  std::vector<RowPainter> painters;
  std::vector<std::vector<float>> rows;  ///< One a worker.
  std::vector<float> whole;              ///< The picture in linear light, where it is to be softened.
  Softening softening;
  FramePlan plan;
  Sensor sensor;
  const SyntheticFrame* frame = nullptr;
  std::uint8_t* rgb = nullptr;
  std::size_t stride = 0;
};

namespace {

constexpr int rows_at_once = 8;

template <typename Row>
void each_row(int worker, int workers, int height, Row row) {
  for (int y = 0; y < height; ++y) {
    if (y / rows_at_once % workers == worker) row(y);
  }
}

std::uint64_t row_seed(const SyntheticFrame& frame, int row) {
  return scramble(frame.noise_seed) + static_cast<std::uint64_t>(row);
}

/// Area in pixels that a cell's front shows where nothing hides it.
double expected_area(const SyntheticFrame& frame, const SyntheticMarker& marker, int cell) {
  const Shape& shape = marker.rod->spec().shape;
  const Pose& pose = marker.T_camera_marker.middle();
  const CentrelinePoint middle = shape.at((cell + 0.5) * shape.pitch());
  const Vec3 p = pose * middle.position;
  if (p.z <= 0) return 0;
  const double along = dot(normalized(p), rotate(pose.rotation, middle.tangent));
  constexpr double flattest = 0.25;
  const double width = std::max(flattest, std::sqrt(std::max(0.0, 1 - along * along)));
  return 2 * shape.radius() * shape.pitch() * width * frame.intrinsics.fx * frame.intrinsics.fy / (p.z * p.z);
}

}  // namespace

void SyntheticRenderer::State::paint_rows(int worker) {
  const std::size_t w = static_cast<std::size_t>(worker), width = static_cast<std::size_t>(frame->width);
  RowPainter& painter = painters[w];
  painter.begin(*frame, plan);
  rows[w].resize(4 * width);
  const bool soften = frame->effects.blur > 0;
  each_row(worker, workers.count(), frame->height, [&](int y) {
    const std::size_t row = static_cast<std::size_t>(y);
    float* const light = soften ? whole.data() + row * 4 * width : rows[w].data();
    painter.paint(y, light);
    if (soften) {
      softening.along(light, width, rows[w].data());
    } else {
      sensor.develop(light, width, row_seed(*frame, y), rgb + row * stride);
    }
  });
}

void SyntheticRenderer::State::develop_softened(int worker) {
  const std::size_t width = static_cast<std::size_t>(frame->width);
  float* const light = rows[static_cast<std::size_t>(worker)].data();
  each_row(worker, workers.count(), frame->height, [&](int y) {
    softening.across(whole.data(), 4 * width, frame->height, y, light);
    sensor.develop(light, width, row_seed(*frame, y), rgb + static_cast<std::size_t>(y) * stride);
  });
}

void SyntheticRenderer::State::count_cells(std::span<int> cells_visible) const {
  const double weight = 1.0 / RowPainter::rays_per_pixel(*frame, plan);
  constexpr double enough = 0.25;
  for (std::size_t m = 0; m < std::min(cells_visible.size(), frame->markers.size()); ++m) {
    cells_visible[m] = 0;
    for (int c = 0; c < frame->markers[m].rod->spec().shape.cells(); ++c) {
      int hits = 0;
      for (const RowPainter& p : painters) hits += p.hits()[m * max_cells + static_cast<std::size_t>(c)];
      const double expected = expected_area(*frame, frame->markers[m], c);
      if (hits > 0 && hits * weight >= enough * expected) ++cells_visible[m];
    }
  }
}

SyntheticRenderer::SyntheticRenderer(int threads) : state_(std::make_unique<State>(std::clamp(threads, 1, 16))) {}
SyntheticRenderer::~SyntheticRenderer() = default;

void SyntheticRenderer::render(const SyntheticFrame& frame, std::uint8_t* rgb, std::size_t stride,
                               std::span<int> cells_visible) {
  State& s = *state_;
  s.frame = &frame;
  s.rgb = rgb;
  s.stride = stride;
  s.plan.make(frame);
  s.sensor.set(frame.effects.noise, frame.effects.gain, frame.effects.light_kelvin);
  s.rows.resize(s.painters.size());
  if (frame.effects.blur > 0) {
    s.whole.resize(4 * static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
    s.softening.set(frame.effects.blur);
  }
  s.workers.run([](void* state, int worker) { static_cast<State*>(state)->paint_rows(worker); }, &s);
  if (frame.effects.blur > 0) {
    s.workers.run([](void* state, int worker) { static_cast<State*>(state)->develop_softened(worker); }, &s);
  }
  s.count_cells(cells_visible);
}

SyntheticImage render_synthetic(const SyntheticFrame& frame) {
  SyntheticImage image{frame.width, frame.height, {}, std::vector<int>(frame.markers.size())};
  const std::size_t stride = 3 * static_cast<std::size_t>(frame.width);
  image.rgb.resize(stride * static_cast<std::size_t>(frame.height));
  SyntheticRenderer().render(frame, image.rgb.data(), stride, image.cells_visible);
  return image;
}

}  // namespace onestroke
