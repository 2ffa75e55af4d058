#pragma once

#include "core/head_tracker.h"
#include "core/time.h"
#include "render/gpu.h"
#include "render/view.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace onestroke {

struct RenderTarget;

/// Letters and digits are their own lower-case character: Key{'l'}.
enum class Key : int {
  none = 0,
  tab = '\t',
  enter = '\n',
  escape = 27,
  space = ' ',
  left = 256,
  right,
  up,
  down,
  page_up,
  page_down,
};

/// One frame as the display wants it.
struct FrameInfo {
  /// False: draw nothing, but call end() all the same (minimised, or the headset is off).
  bool should_render = false;
  /// When the frame will be seen.
  Time time;
  /// When the views were last asked for, where they follow a head.
  Time located;
  /// Where from, and where in the target. A display that tracks no head gives views at the world's origin with a field
  /// of view of its own; the caller may move them before drawing.
  std::array<View, max_views> views{};
  int view_count = 0;
  const RenderTarget* target = nullptr;

  std::span<const View> seen() const { return {views.data(), static_cast<std::size_t>(view_count)}; }
};

/// Something to look at: a window, a headset, a folder of pictures. One thread, the one that renders, but for
/// head_at().
///
///   Gpu gpu({display->needs(), ...});  display->attach(gpu);
///   while (!display->closed()) { display->begin(frame); if (frame.should_render) renderer.draw(...);
///   display->end(frame); } display->finish();
class Display : public HeadTracker {
 public:
  virtual GpuNeeds needs() const = 0;
  /// Makes surface and images, before the first begin(). Called again, with another Gpu and after everything else that
  /// was made from the first is gone, where that was lost: the show goes on, its clock and its files with it. Throws
  /// Error.
  virtual void attach(Gpu& gpu) = 0;

  /// Waits for the time to draw the next frame. Every begin() is followed by one end() with the same info, where
  /// should_render may have become false: nothing was drawn then.
  virtual void begin(FrameInfo& frame) = 0;
  /// Moves the views to where they are expected by now, for the time of the frame; false where they stay. Between
  /// begin() and end(), as late as can be. Does not throw.
  virtual bool move_views(FrameInfo&) { return false; }
  /// Shows what was drawn. Neither throws; a display that cannot go on closes, and finish() says why.
  virtual void end(const FrameInfo& frame) = 0;

  /// Keys pressed since the last call; valid until the next. Also where a window takes notice of the world.
  virtual std::span<const Key> poll() = 0;
  virtual bool closed() const = 0;
  /// True where the GPU was lost while the display used it: no frame is rendered until attach() brings another.
  virtual bool gpu_lost() const { return false; }
  /// True where views follow the wearer's head and must not be moved.
  virtual bool tracks_head() const = 0;
  /// True where the world is seen behind what is drawn: no camera's picture is to be drawn, and where nothing is drawn
  /// there is to be no light and no opacity. The same from the start to the end.
  virtual bool shows_world() const { return false; }
  std::optional<Pose> head_at(Time) const override { return std::nullopt; }
  /// What the headset is called; empty where there is none.
  virtual std::string headset() const { return {}; }

  /// Moves the world's origin to where the head is, upright and looking ahead, from the next begin() on. False where no
  /// head is tracked.
  virtual bool recentre() { return false; }

  /// Ends the show: waits, and finishes files. Throws Error with what went wrong since attach(). Harmless when called
  /// twice.
  virtual void finish() = 0;
  /// What there is to show for it, a line each ("wrote out/film.mp4, 120 frames"); complete after finish().
  virtual std::vector<std::string> report() const { return {}; }
};

}  // namespace onestroke
