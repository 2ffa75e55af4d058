#include "files/libav.h"

#include "core/error.h"

#include <array>

namespace onestroke {

void FreeAv::operator()(AVFormatContext* p) const {
  if (p->iformat) {
    avformat_close_input(&p);
    return;
  }
  avio_closep(&p->pb);
  avformat_free_context(p);
}

std::string words_of_av(int result) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(result, text.data(), text.size());
  return text.data();
}

int check_written(int result, const std::string& name) {
  if (result < 0) throw Error("cannot write " + name + ": " + words_of_av(result));
  return result;
}

void flush_written(AVFormatContext& format, const std::string& name) {
  avio_flush(format.pb);
  check_written(format.pb->error, name);
}

bool is_key(const AVFrame& frame) {
#if LIBAVUTIL_VERSION_INT >= AV_VERSION_INT(58, 29, 100)
  return (frame.flags & AV_FRAME_FLAG_KEY) != 0;
#else
  return frame.key_frame == 1;
#endif
}

}  // namespace onestroke
