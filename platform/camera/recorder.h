#pragma once

#include "camera/recording_writer.h"
#include "core/frame_sink.h"
#include "core/spsc_queue.h"

#include <array>
#include <atomic>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace onestroke {

/// On its way to the thread that copies.
struct LentPicture {
  PictureHandle picture;
  FrameRecord record;
  std::uint64_t missed = 0;  ///< So many were left out before it.
};
/// On its way to the thread that writes, its pixels in a buffer of the recorder's.
struct CopiedPicture {
  Picture picture, second;
  bool pair = false;
  FrameRecord record;
  std::uint64_t missed = 0;
};

/// Who hears of a recorder.
struct RecorderListeners {
  /// Once and on a thread of the recorder's: why the recording ended before the tracking.
  std::function<void(const std::string&)> failed{};
  /// On the writing thread, before each picture; for tests.
  std::function<void()> writes{};
};

/// Records what is tracked, beside it. The tracking thread only hands pictures on: it neither waits nor allocates. One
/// thread copies them, so that the camera soon has its buffers again, of which two at most are held, and another one
/// writes them. Where the recording cannot be written any further it ends, and the tracking does not.
class Recorder final : public FrameSink {
 public:
  /// How many pictures may wait to be written.
  static constexpr std::size_t waiting = 8;

  /// Throws Error as RecordingWriter does.
  Recorder(const std::filesystem::path& folder, const RecordingHeader& header, const Catalog& catalog,
           RecorderListeners listeners = {});
  ~Recorder() override;
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  bool add(const PictureHandle& picture, const FrameRecord& record) noexcept override;
  void leave_out() noexcept override { ++missed_; }

  /// Writes what waits, and ends the recording. After the last add(). A second call does nothing.
  void close() noexcept;
  /// Why the recording ended before the tracking, one line; empty while it goes well. Any thread.
  std::string failure() const;
  const std::filesystem::path& folder() const { return writer_.folder(); }
  /// Pictures that are in the recording, and those that are not. After close().
  std::uint64_t written() const { return written_; }
  std::uint64_t left_out() const { return left_out_; }

 private:
  void copy_until(const std::stop_token& stop) noexcept;
  void write_until(const std::stop_token& stop) noexcept;
  bool copy(const LentPicture& lent);
  void copy_into(CopiedPicture& slot, const LentPicture& lent);
  void write(const CopiedPicture& copied);
  void fail(const char* why) noexcept;

  RecordingWriter writer_;
  const RecorderListeners listeners_;
  SpscQueue<LentPicture> lent_{2};
  SpscQueue<CopiedPicture> copied_{waiting};
  std::uint64_t missed_ = 0;  // the tracking thread's
  // The copying thread's; a buffer belongs to the place in the queue that has its number.
  std::array<std::vector<std::uint8_t>, waiting> buffers_;
  std::array<std::string, waiting> names_;
  std::uint64_t copies_ = 0;
  // The writing thread's.
  std::uint64_t written_ = 0, left_out_ = 0;
  std::string failure_;
  std::atomic<bool> failing_{false}, failed_{false};
  std::atomic<std::size_t> on_the_way_{0};  // from add() until it is written
  std::jthread writing_, copying_;
};

}  // namespace onestroke
