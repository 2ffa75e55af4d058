#pragma once

#include "core/frame_record.h"
#include "core/picture.h"
#include "marker/catalog.h"

#include <memory>

namespace onestroke {

struct TrackerOptions {
  /// Each picture alone: no memory, nothing predicted. For sets of unrelated pictures.
  bool independent = false;
  /// How long a marker that is not found is carried on at constant velocity (`predicted`), and how long after that it
  /// is still reported, as `lost`.
  Duration predict_for = Duration::from_ms(250), report_lost_for = Duration::from_ms(750);
  /// While all markers that were seen are followed, a picture is searched as a whole this often, in pictures, for
  /// others that come into sight; and thoroughly, which takes much longer, this often at most.
  int search_every = 8, search_thoroughly_every = 32;
  /// While a marker is missing every picture is searched, and thoroughly this often at most.
  int miss_thoroughly_every = 2;
};

/// Picture in, marker poses out. Used by one thread at a time.
class PictureTracker {
 public:
  virtual ~PictureTracker() = default;

  /// Finds every marker of the catalogue in the picture and fills the whole record. Markers beyond
  /// max_markers_per_frame are left out, the worst first. Pictures come in the order of their times; a picture older
  /// than the last starts afresh.
  virtual void process(const Picture& picture, FrameRecord& record) = 0;
};

/// Of one camera; the second picture of a pair is not looked at.
class Tracker final : public PictureTracker {
 public:
  explicit Tracker(Catalog catalog, const TrackerOptions& options = {});
  ~Tracker() override;
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;

  void process(const Picture& picture, FrameRecord& record) override;
  const Catalog& catalog() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onestroke
