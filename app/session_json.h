#pragma once

#include "app/session_frame.h"

#include <string>

namespace onestroke {

/// The lines of a session's log, one JSON object each, here without the line's end:
///
///   {"onestroke_session": 1, "program": "1.0", "camera": ..., "catalog": ..., "rate": 30, ...}
///   {"now_ns": 0, "picture": true, "keys": ["l", 32], "events": ["Link"], "lens": {...}, "second": {...}, "record":
///   {...}}
///   {"missed": 3}
///
/// "picture", "keys", "events", "lens", "second" and "record" are there where they are new; "second" is null where a
/// pair becomes one picture. Numbers are read back bit for bit,
/// and what is no number is a text ("nan", "inf", "-inf"). A pose is [w, x, y, z, x, y, z]: quaternion, translation in
/// mm; a velocity is [x, y, z, x, y, z], rad/s and mm/s.
inline constexpr int session_format = 1;

std::string session_line(const SessionHeader& header);
/// The objects that are "record", "lens" and "second" in a frame's line.
struct SessionTexts {
  std::string record, lens, second;
};
/// A frame's line with these; empty ones are left out.
std::string session_line(const SessionFrame& frame, const SessionTexts& texts);
std::string session_text(const FrameRecord& record);
std::string session_text(const PictureLens& lens);
std::string session_text(const SecondLens& second);
/// What is not in the log.
std::string session_line_missed(std::uint64_t frames);

/// Each throws Error, which names neither file nor line, where the text is not such a line.
SessionHeader header_of_line(const std::string& line);
/// Changes what the line tells: keys, events and `picture` are the line's alone, the rest stays as it was. False, and
/// `missed` added to, where the line tells of frames that are missing.
bool read_session_line(const std::string& line, SessionFrame& frame);

}  // namespace onestroke
