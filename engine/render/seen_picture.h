#pragma once

#include "render/finger_layer.h"
#include "render/picture_store.h"

#include <array>

namespace onestroke {

/// A picture of the camera on the GPU, and the fingers in it.
struct SeenPicture {
  explicit SeenPicture(Device& device) : store(device), fingers(device) {}

  void record(FrameSlot& slot) {
    store.record(slot);
    fingers.record(slot);
  }

  PictureStore store;
  FingerLayer fingers;
};

/// The pictures that a frame's views see: all of them the first, or the right one of two eyes the second.
struct SeenPictures {
  SeenPicture& first;
  SeenPicture* second = nullptr;  ///< Null where there is none.

  std::size_t count() const { return second ? 2 : 1; }
  SeenPicture& at(std::size_t picture) const { return picture == 0 ? first : *second; }
  /// Which one a view sees, the `view`th of `views`.
  std::size_t of_view(std::size_t view, std::size_t views) const { return second && views == 2 ? view : 0; }
};

}  // namespace onestroke
