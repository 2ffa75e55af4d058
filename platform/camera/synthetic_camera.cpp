#include "camera/synthetic_camera.h"

#include "camera/hand_script.h"
#include "camera/sensor.h"
#include "core/error.h"
#include "core/picture_pool.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <numbers>

namespace onestroke {
namespace {

constexpr std::size_t buffers = 7;
constexpr std::size_t most_hands = 2;
// Of a head that nobody scripted, rad.
constexpr double any_turn = std::numbers::pi;

const MarkerSpec& marker_of(const Catalog& catalog, std::optional<int> id, std::size_t otherwise) {
  if (id) {
    for (const MarkerSpec& m : catalog.markers) {
      if (m.id == *id) return m;
    }
    throw Error("camera synthetic: the catalogue has no marker " + std::to_string(*id) + "; give an id that it has");
  }
  if (catalog.markers.size() <= otherwise) {
    throw Error("camera synthetic: the catalogue has " + std::to_string(catalog.markers.size()) +
                " markers and the script needs " + std::to_string(otherwise + 1) + "; add markers to it");
  }
  return catalog.markers[otherwise];
}

std::vector<std::unique_ptr<const Rod>> make_rods(const SyntheticOptions& options, const Catalog& catalog) {
  std::vector<std::unique_ptr<const Rod>> rods;
  if (shows_two_hands(options.script)) {
    rods.push_back(std::make_unique<const Rod>(marker_of(catalog, options.first_id, 0)));
    rods.push_back(std::make_unique<const Rod>(marker_of(catalog, options.second_id, 1)));
  } else {
    rods.push_back(std::make_unique<const Rod>(marker_of(catalog, options.marker, 0)));
  }
  return rods;
}

std::vector<const Rod*> pointers(const std::vector<std::unique_ptr<const Rod>>& rods) {
  std::vector<const Rod*> out;
  for (const auto& rod : rods) out.push_back(rod.get());
  return out;
}

void sleep_until(Time when) {
  timespec at{};
  at.tv_sec = when.ns / 1'000'000'000;
  at.tv_nsec = when.ns % 1'000'000'000;
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr) != 0) {
  }
}

/// What of the room a head that sways a little and turns by head_turn, rad, ever sees; a lens that bends much sees the
/// edge repeated.
Room::Extent seen(const SyntheticOptions& options, const Intrinsics& k, double head_turn) {
  constexpr double sway = 0.12;  // rad
  const double across = std::atan(std::max(k.cx, options.width - k.cx) / k.fx) + sway + head_turn;
  const double down = std::atan(std::max(k.cy, options.height - k.cy) / k.fy) + sway;
  const Room::Extent whole;
  return {std::min(across, whole.half_turn), std::min(std::tan(std::min(down, 1.4)), whole.half_height)};
}

Room make_room(const SyntheticOptions& options, const Intrinsics& k, double head_turn) {
  constexpr double most_texels = 2.2e6;
  const Room::Extent extent = seen(options, k, head_turn);
  const double finest = std::sqrt(most_texels / (4 * extent.half_turn * extent.half_height));
  return Room(std::min(k.fx, finest), options.seed, extent);
}

class SyntheticCamera : public Camera {
 public:
  SyntheticCamera(const SyntheticOptions& options, const Catalog& catalog, const Intrinsics& intrinsics,
                  const HeadMount& mount, const SyntheticRig& rig)
      : options_(options),
        mount_(mount),
        T_first_camera_(rig.T_first_camera * Pose{{}, {options.right_mm, 0, 0}}),
        rods_(make_rods(options, catalog)),
        script_(options, pointers(rods_)),
        room_(make_room(options, intrinsics,
                        mount.head ? any_turn : script_.head_turn() + angle_between(T_first_camera_.rotation, {}))),
        renderer_(options.threads),
        pool_(buffers, 3 * static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height)),
        began_(rig.live_since) {
    frame_.intrinsics = intrinsics;
    frame_.width = options.width;
    frame_.height = options.height;
    frame_.room = &room_;
    frame_.effects.exposure = Duration::from_ms(options.exposure_ms);
    frame_.effects.readout = Duration::from_ms(options.readout_ms.value_or(0));
    frame_.effects.noise = options.noise;
    frame_.effects.gain = options.gain;
    frame_.effects.light_kelvin = options.light_kelvin;
    frame_.effects.blur = options.blur;
    for (const auto& rod : rods_) frame_.markers.push_back({rod.get(), {}});
    frame_.fingers.resize(rods_.size() * script_.capsules());
    for (std::size_t i = 0; i < frame_.fingers.size(); ++i) {
      script_.size_capsule(i % script_.capsules(), frame_.fingers[i]);
    }
  }

  Status next(PictureHandle& picture) override {
    if (length() != 0 && next_ >= length()) return Status::end;
    PictureHandle::Loan* loan = pool_.acquire();
    if (!loan) return Status::busy;
    const Duration span = frame_.effects.exposure + frame_.effects.readout;
    const Time turn = options_.live ? wait_for_turn() - span : Time{since_start(next_).ns};
    // By its number, so that a live picture can be made again.
    pose_frame(since_start(next_), turn, span);
    draw(*loan);
    fill(loan->picture, turn);
    picture = PictureHandle(*loan);
    ++next_;
    return Status::ok;
  }

  std::string message() const override { return {}; }
  bool live() const override { return options_.live; }
  double rate() const override { return options_.fps; }

  std::size_t length() const override {
    if (options_.seconds > 0) return static_cast<std::size_t>(std::ceil(options_.seconds * options_.fps - 1e-6));
    const bool turns = !shows_two_hands(options_.script) && options_.script != ScriptKind::still;
    return turns && !options_.live ? static_cast<std::size_t>(std::ceil(360 / options_.step_deg - 1e-6)) : 0;
  }

  double period() const override { return shows_two_hands(options_.script) ? script_.period() : 0; }

  std::span<const TrueMarker> truth(const Picture& picture) const override {
    const std::size_t i = pool_.index(picture);
    return i < buffers ? std::span(truths_[i]).first(rods_.size()) : std::span<const TrueMarker>{};
  }

 private:
  Duration since_start(std::uint64_t index) const {
    return Duration::from_seconds(static_cast<double>(index) / options_.fps);
  }

  /// The end of the next exposure; where the program was slow, of the newest one that is over.
  Time wait_for_turn() {
    if (began_.ns == 0) began_ = Time::now();
    const double now = (Time::now() - began_).seconds();
    next_ = std::max(next_, static_cast<std::uint64_t>(std::max(0.0, now * options_.fps)));
    const Time due = began_ + since_start(next_);
    sleep_until(due);
    return due;
  }

  /// `start` is the script's time and `turn` the picture's.
  void pose_frame(Duration start, Time turn, Duration span) {
    std::array<double, PosePath::knots> at{};
    std::array<Pose, PosePath::knots> head, poses, T_camera_world;
    for (std::size_t k = 0; k < at.size(); ++k) {
      at[k] = start.seconds() + span.seconds() * static_cast<double>(k) / (PosePath::knots - 1);
      head[k] = mount_.head ? seen_by_head(turn + static_cast<std::int64_t>(k) * span / (PosePath::knots - 1))
                            : script_.T_world_camera(at[k]) * T_first_camera_;
      T_camera_world[k] = inverse(head[k]);
    }
    frame_.T_world_camera = PosePath(head);
    for (std::size_t hand = 0; hand < rods_.size(); ++hand) {
      for (std::size_t k = 0; k < at.size(); ++k) poses[k] = T_camera_world[k] * script_.T_world_marker(hand, at[k]);
      frame_.markers[hand].T_camera_marker = PosePath(poses);
      for (std::size_t c = 0; c < script_.capsules(); ++c) {
        for (std::size_t k = 0; k < at.size(); ++k) {
          poses[k] = T_camera_world[k] * script_.T_world_capsule(hand, c, at[k]);
        }
        frame_.fingers[hand * script_.capsules() + c].T_camera_finger = PosePath(poses);
      }
    }
    frame_.noise_seed = scramble(options_.seed + place_seed()) + next_ * 0x10001;
  }

  /// No two sensors have the same noise.
  std::uint64_t place_seed() const {
    const Vec3 t = T_first_camera_.translation;
    return static_cast<std::uint64_t>(std::llround(1e3 * norm(t)));
  }

  /// Where the head is lost it stays.
  Pose seen_by_head(Time time) {
    T_world_head_camera_ = mount_.T_world_camera(time).value_or(T_world_head_camera_);
    return T_world_head_camera_;
  }

  void draw(PictureHandle::Loan& loan) {
    std::array<int, most_hands> visible{};
    renderer_.render(frame_, pool_.bytes(loan).data(), 3 * static_cast<std::size_t>(options_.width),
                     std::span(visible).first(rods_.size()));
    for (std::size_t hand = 0; hand < rods_.size(); ++hand) {
      truths_[pool_.index(loan)][hand] = {rods_[hand]->spec().id, frame_.markers[hand].T_camera_marker.middle(),
                                          visible[hand]};
    }
    loan.picture.planes[0] = pool_.bytes(loan).data();
  }

  void fill(Picture& picture, Time start) const {
    picture.width = options_.width;
    picture.height = options_.height;
    picture.format = PixelFormat::rgb8;
    picture.strides[0] = 3 * static_cast<std::size_t>(options_.width);
    picture.sequence = next_;
    picture.exposure = {start, frame_.effects.exposure, frame_.effects.readout};
    picture.intrinsics = frame_.intrinsics;
    picture.T_world_camera = frame_.T_world_camera.middle();
    picture.source = "";
  }

  SyntheticOptions options_;
  HeadMount mount_;
  const Pose T_first_camera_;
  Pose T_world_head_camera_ = mount_.T_head_camera;
  std::vector<std::unique_ptr<const Rod>> rods_;
  HandScript script_;
  Room room_;
  SyntheticRenderer renderer_;
  SyntheticFrame frame_;
  PicturePool pool_;
  std::array<std::array<TrueMarker, most_hands>, buffers> truths_;
  Time began_;
  std::uint64_t next_ = 0;
};

}  // namespace

std::unique_ptr<Camera> make_synthetic_camera(const SyntheticOptions& options, const Catalog& catalog,
                                              const std::optional<Intrinsics>& intrinsics, const HeadMount& mount,
                                              const SyntheticRig& rig) {
  return std::make_unique<SyntheticCamera>(
      options, catalog,
      intrinsics.value_or(
          Intrinsics::from_fov(options.width, options.height, options.fov_deg * std::numbers::pi / 180)),
      mount, rig);
}

}  // namespace onestroke
