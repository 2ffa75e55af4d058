#include "camera/jpeg_decoder.h"

#include "camera/jpeg_memory.h"
#include "camera/picture_bytes.h"

#include <jerror.h>
#include <jpeglib.h>

#include <csetjmp>

namespace onestroke {
namespace {

/// libjpeg's way to say that it cannot go on.
struct Complaints {
  jpeg_error_mgr manager{};  // first, so that one is found by the other
  std::jmp_buf way_out{};
  bool damaged = false;
};

Complaints& complaints(j_common_ptr info) {
  return *reinterpret_cast<Complaints*>(info->err);
}

[[noreturn]] void leave(j_common_ptr info) {
  std::longjmp(complaints(info).way_out, 1);
}

void note(j_common_ptr info, int level) {
  // Cameras send a byte or two too many between scans, which spoil nothing.
  const bool harmless = info->err->msg_code == JWRN_EXTRANEOUS_DATA || info->err->msg_code == JWRN_JFIF_MAJOR ||
                        info->err->msg_code == JWRN_ADOBE_XFORM;
  if (level < 0 && !harmless) complaints(info).damaged = true;
}

void keep_quiet(j_common_ptr) {}

}  // namespace

struct JpegDecoder::Impl {
  Complaints errors;
  JpegMemory memory;
  jpeg_decompress_struct decoder{};

  Impl() {
    decoder.err = jpeg_std_error(&errors.manager);
    errors.manager.error_exit = leave;
    errors.manager.emit_message = note;
    errors.manager.output_message = keep_quiet;
    if (setjmp(errors.way_out) != 0) throw std::bad_alloc();
    jpeg_create_decompress(&decoder);
    memory.attach(decoder);
  }
  ~Impl() {
    if (setjmp(errors.way_out) == 0) jpeg_destroy_decompress(&decoder);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  /// Nothing in here has a destructor, which a jump would pass by.
  Result decode(std::span<const std::uint8_t> jpeg, PictureSize size, std::uint8_t* rgb, std::size_t stride) noexcept {
    errors.damaged = false;
    if (setjmp(errors.way_out) != 0) {
      abort();
      return Result::damaged;
    }
    jpeg_mem_src(&decoder, jpeg.data(), jpeg.size());
    jpeg_read_header(&decoder, TRUE);
    if (static_cast<int>(decoder.image_width) != size.width || static_cast<int>(decoder.image_height) != size.height) {
      abort();
      return Result::other_size;
    }
    decoder.out_color_space = JCS_RGB;
    jpeg_start_decompress(&decoder);
    while (decoder.output_scanline < decoder.output_height) {
      JSAMPROW row = rgb + decoder.output_scanline * stride;
      jpeg_read_scanlines(&decoder, &row, 1);
    }
    jpeg_finish_decompress(&decoder);
    return errors.damaged ? Result::damaged : Result::ok;
  }

  void abort() noexcept {
    if (setjmp(errors.way_out) == 0) jpeg_abort_decompress(&decoder);
  }
};

JpegDecoder::JpegDecoder() : impl_(std::make_unique<Impl>()) {}
JpegDecoder::~JpegDecoder() = default;

JpegDecoder::Result JpegDecoder::decode(std::span<const std::uint8_t> jpeg, PictureSize size, std::uint8_t* rgb,
                                        std::size_t stride) noexcept {
  if (!jpeg_is_complete(jpeg)) return Result::cut;
  return impl_->decode(jpeg, size, rgb, stride);
}

}  // namespace onestroke
