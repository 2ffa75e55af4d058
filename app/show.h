#pragma once

#include "app/frame_feed.h"
#include "app/model_shelf.h"
#include "app/status_line.h"
#include "app/two_hands.h"
#include "render/display.h"
#include "render/renderer.h"

#include <functional>
#include <limits>

namespace onestroke {

/// When a show ends by itself.
struct ShowLimits {
  std::size_t pictures = std::numeric_limits<std::size_t>::max();
  Duration length{std::numeric_limits<std::int64_t>::max()};  ///< By the display's clock.
};

/// The render loop: frame after frame, the newest of the feed, seen by the display's views. Nothing in it throws on its
/// own account, waits for a lock or allocates once all models are there and pictures of the same size have come.
class Show {
 public:
  /// All outlive the show.
  struct Parts {
    Display& display;
    Renderer& renderer;
    TrackingThread& tracking;
    ModelShelf& shelf;
  };

  Show(const Parts& parts, FrameFeed::Pace pace, PictureTime mode);

  /// Until the feed or a limit ends it, the display closes, or somebody asks. `say` hears how many pictures were shown.
  /// Throws Error where the GPU cannot go on.
  void run(const ShowLimits& limits, const std::function<void(std::size_t pictures)>& say);

 private:
  /// What a picture says of its camera.
  struct Lens {
    Intrinsics intrinsics;
    int width = 0, height = 0;
    Pose T_world_camera;
  };

  bool press(Key key);
  bool draw(FrameInfo& frame, bool new_picture);
  void take_picture();
  void stand_at_camera(FrameInfo& frame) const;

  Parts parts_;
  FrameFeed feed_;
  TwoHands hands_;
  StatusLine status_;
  Lens lens_;
  bool paused_ = false;
};

}  // namespace onestroke
