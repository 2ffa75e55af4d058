#pragma once

#include <memory>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

namespace onestroke {

/// Frees what libav made; a file that is read closes with its context.
struct FreeAv {
  void operator()(AVCodecContext* p) const { avcodec_free_context(&p); }
  void operator()(AVFrame* p) const { av_frame_free(&p); }
  void operator()(AVPacket* p) const { av_packet_free(&p); }
  void operator()(SwsContext* p) const { sws_freeContext(p); }
  void operator()(AVFormatContext* p) const;
};
template <typename T>
using HeldAv = std::unique_ptr<T, FreeAv>;

/// What a negative result of libav's means, in its own words.
std::string words_of_av(int result);
/// Throws Error, "cannot write NAME: ...", where the result is negative; returns it otherwise.
int check_written(int result, const std::string& name);
/// The same where nothing was made.
template <typename T>
T* check_written(T* made, const std::string& name) {
  if (!made) check_written(AVERROR(ENOMEM), name);
  return made;
}
/// Puts what waits in the context's buffers into its file, where a full disk shows. Throws Error likewise.
void flush_written(AVFormatContext& format, const std::string& name);

/// True where the frame can be decoded without any before it.
bool is_key(const AVFrame& frame);

}  // namespace onestroke
