#pragma once

#include "camera/playback.h"
#include "core/camera.h"
#include "core/picture_pool.h"

#include <atomic>
#include <limits>
#include <memory>
#include <optional>

namespace onestroke {

/// What recordings have in common as cameras: seven buffers, seeking, and beginning again at the end.
class RecordedCamera : public Camera {
 public:
  Status next(PictureHandle& picture) final;
  std::string message() const final { return message_; }
  bool live() const final { return false; }
  std::size_t length() const final { return playback_.loop ? 0 : pictures() - std::min(pictures(), skipped_); }
  double period() const final;
  /// Within the round that is being played.
  bool seek(Duration after_start) final;
  Time began() const final { return began_; }

  /// By whoever opens the camera, before the first next(). Throws Error where the recording is over before
  /// playback.from.
  void play(const Playback& playback);

 protected:
  static constexpr std::size_t buffers = 7;

  /// name: of the recording, for messages.
  explicit RecordedCamera(std::string name) : name_(std::move(name)) {}

  /// By a derived camera's constructor.
  void set_buffers(std::size_t bytes_each) { pool_ = std::make_unique<PicturePool>(buffers, bytes_each); }
  void set_first(Time began, std::uint64_t number) { began_ = began, first_number_ = number; }
  PicturePool& pool() { return *pool_; }
  /// The camera ends, with these words.
  void fail(std::string message) { message_ = std::move(message); }
  const std::string& name() const { return name_; }

  /// Fills the buffer and its Picture, as if the recording were played once. False at the end, and after fail().
  virtual bool read(PictureHandle::Loan& loan) = 0;
  /// read() goes on with the first picture that is no earlier than this. False where there is none, and after fail();
  /// read() then is at its end.
  virtual bool go_to(Duration after_start) = 0;
  /// How many there are; 0 where that is not known.
  virtual std::size_t pictures() const = 0;

  /// Brings a picture's time and number into the round that is being played.
  void shift(Picture& picture) const;

 private:
  Status take(PictureHandle& picture);
  bool begin_again();

  static constexpr std::int64_t nowhere = std::numeric_limits<std::int64_t>::min();

  const std::string name_;
  std::unique_ptr<PicturePool> pool_;
  Playback playback_;
  Time began_, last_;  // last_ and last_number_: of those that were read, in a recording that is played once
  std::uint64_t first_number_ = 0, last_number_ = 0;
  std::size_t skipped_ = 0;
  Duration later_;            // in the round that is being played
  std::uint64_t higher_ = 0;  // likewise
  std::atomic<std::int64_t> wanted_{nowhere};
  bool any_ = false, over_ = false;
  std::string message_;
};

}  // namespace onestroke
