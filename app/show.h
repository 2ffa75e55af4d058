#pragma once

#include "app/covered_cells.h"
#include "app/desktop_hud.h"
#include "app/feed.h"
#include "app/frame_meter.h"
#include "app/graphics.h"
#include "app/session_log.h"
#include "app/snapshots.h"
#include "app/two_hands.h"
#include "render/display.h"

#include <functional>
#include <limits>
#include <optional>

namespace onestroke {

/// When a show ends by itself.
struct ShowLimits {
  std::size_t pictures = std::numeric_limits<std::size_t>::max();
  Duration length{std::numeric_limits<std::int64_t>::max()};  ///< By the display's clock.
};

/// How a show is shown.
struct ShowOptions {
  bool fingers = true;  ///< Whether those that hold a stick are shown before the model behind them.
  bool left_handed = false;
  std::filesystem::path snapshots = "snapshots";  ///< The folder that they are saved to.
};

/// The render loop: frame after frame, the newest of the feed, seen by the display's views. Nothing in it throws on its
/// own account, waits for a lock or allocates once all models are there and pictures of the same size have come. Where
/// the GPU is lost, all that is on it is made again, and the show goes on with the frame that was lost.
class Show {
 public:
  /// A GPU that is lost again so soon, by the display's clock, will not stay.
  static constexpr Duration lost_again_within = Duration::from_seconds(10);

  /// All outlive the show.
  struct Parts {
    Display& display;
    Graphics& graphics;
    Feed& feed;
    SessionLog* log = nullptr;  ///< Where the show is written down, if anywhere.
  };

  explicit Show(const Parts& parts, const ShowOptions& options = {});

  /// Until the feed or a limit ends it, the display closes, or somebody asks. `say` hears how many pictures were shown.
  /// Throws Error where the GPU cannot go on, or was lost for the second time within a short while.
  void run(const ShowLimits& limits, const std::function<void(std::size_t pictures)>& say);
  /// Waits for the last one.
  int snapshots_saved() { return snapshots_.wait(), snapshots_.saved(); }

 private:
  bool press(Key key);
  bool draw(FrameInfo& frame, bool new_picture);
  void show(FrameInfo& frame, bool new_picture);
  bool lost() const;
  void recover(Time now);
  void take_picture();
  void show_picture();
  void write_down(bool new_picture);
  void take_snapshot(const FrameScene& scene, const View& view);
  std::string_view notice() const;
  float brightness() const;
  void stand_at_camera(FrameInfo& frame) const;
  void measure(bool new_picture);
  std::optional<Latency> latency_of(const FrameInfo& frame) const;

  Parts parts_;
  const bool fingers_;
  const bool films_;  // every picture counts, and may be waited for
  const bool shows_world_;
  TwoHands hands_;
  CoveredCells covered_;
  FrameMeter meter_;
  HudWords hud_words_;
  DesktopHud hud_;
  PictureHandle picture_;  // the one that is shown, for a GPU that has not seen it
  // What it says of its camera.
  PictureLens lens_;
  SecondLens second_lens_;
  Pose T_world_camera_;
  std::optional<Latency> latency_;  // of the last frame that was drawn
  std::optional<Time> lost_at_, snapshot_at_;
  bool paused_ = false;
  Key asked_ = Key::none;  // by the menu, in the frame that was drawn last
  Snapshots snapshots_;
};

}  // namespace onestroke
