#pragma once

#include "app/session_json.h"
#include "core/spsc_queue.h"

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <thread>

namespace onestroke {

/// Writes what a show shows to a file from which it can be shown again (session_json.h). A thread of its own writes;
/// the thread that renders hands frames on without waiting, without allocation and without exceptions. Where the file
/// cannot be written any further the log ends, and the show does not.
class SessionLog {
 public:
  /// Replaces the file. Throws Error where it cannot be written.
  SessionLog(std::filesystem::path file, const SessionHeader& header);
  ~SessionLog();
  SessionLog(const SessionLog&) = delete;
  SessionLog& operator=(const SessionLog&) = delete;

  /// Render loop: what belongs to the next frame. What is more than a frame has room for is left out.
  void press(Key key) noexcept { keys_.push_back(key); }
  void happened(std::string_view word) noexcept { events_.push_back(Text(word)); }
  void took(const std::optional<Latency>& latency) noexcept { latency_ = latency; }
  /// Render loop: one frame. Where the writer is too far behind the frame is left out and counted, and its keys and
  /// events go with the next.
  void add(const FrameRecord& record, Time now, bool picture, const PictureLens& lens,
           const SecondLens& second = {}) noexcept;

  /// Writes what waits and ends the log. A second call does nothing.
  void close() noexcept;
  /// Why the log ended before the show, one line; empty while it goes well. Any thread.
  std::string failure() const;
  const std::filesystem::path& file() const { return file_; }

 private:
  static constexpr std::size_t waiting = 64;  // a second of a screen's frames

  void write_until(const std::stop_token& stop) noexcept;
  void write(const SessionFrame& frame);
  void write_line(const std::string& line);
  void fail() noexcept;

  const std::filesystem::path file_;
  std::ofstream out_;
  SpscQueue<SessionFrame> queue_{waiting};
  // The render loop's.
  InlineVector<Key, SessionFrame::most_keys> keys_;
  InlineVector<Text, SessionFrame::most_events> events_;
  std::optional<Latency> latency_;
  std::uint64_t missed_ = 0;
  // The writer's.
  SessionTexts written_{.record = {}, .lens = {}, .second = "null"};  // as they stand in the log
  std::string failure_;
  std::atomic<bool> failed_{false};
  std::jthread writer_;
};

}  // namespace onestroke
