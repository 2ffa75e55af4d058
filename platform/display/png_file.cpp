#include "display/png_file.h"

#include "core/error.h"

#include <png.h>

#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>

namespace onestroke {

namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

void complain(png_structp png, png_const_charp) {
  std::longjmp(png_jmpbuf(png), 1);
}

void ignore(png_structp, png_const_charp) {}

/// False where libpng gives up. Holds no C++ objects, since libpng jumps out of it.
bool write(png_structp png, png_infop info, std::FILE* file, int width, int height, const std::uint8_t* rgba) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_init_io(png, file);
  const auto w = static_cast<png_uint_32>(width), h = static_cast<png_uint_32>(height);
  png_set_IHDR(png, info, w, h, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_compression_level(png, 2);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_write_info(png, info);
  png_set_filler(png, 0, PNG_FILLER_AFTER);
  for (png_uint_32 row = 0; row < h; ++row) png_write_row(png, rgba + std::size_t{4} * w * row);
  png_write_end(png, info);
  return true;
}

}  // namespace

void write_png(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgba) {
  const auto fail = [&path] {
    throw Error("cannot write " + path.string() + ": " + std::strerror(errno ? errno : EIO));
  };
  errno = 0;
  std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "wb"));
  if (!file) fail();
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, complain, ignore);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  const bool written = info && write(png, info, file.get(), width, height, rgba.data());
  png_destroy_write_struct(&png, &info);
  if (!written || std::fflush(file.get()) != 0) fail();
}

}  // namespace onestroke
