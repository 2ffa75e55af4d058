#include "tracking/segmentation.h"

#include <opencv2/core/hal/intrin.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstring>
#include <utility>

namespace onestroke {
namespace {

// Bytes.
constexpr int cache_line = 64;

// Fixed point, 8 fractional bits: the comparison runs once per pixel and gain.
class InkTest {
 public:
  explicit InkTest(const SegmentationOptions& options)
      : red_gain_(static_cast<int>(256 * options.red_gain + 0.5F)),
        blue_gain_(static_cast<int>(256 * options.blue_gain + 0.5F)),
        relative_(static_cast<int>(256 * options.relative_margin + 0.5F)),
        absolute_(static_cast<int>(256 * options.absolute_margin + 0.5F)),
        least_(static_cast<int>(256 * options.least_share + 0.5F)) {}

  std::uint8_t operator()(int red, int green, int blue) const {
    const int r = red_gain_ * red, g = 256 * green, b = blue_gain_ * blue;
    const int high = std::max({r, g, b});
    const int middle = std::max(std::min(r, g), std::min(std::max(r, g), b));
    const int needed = std::max(absolute_, (high >> 8) * relative_);
    if (high - middle < needed || std::min({r, g, b}) < (high >> 8) * least_) return no_ink;
    return high == r ? 0 : (high == g ? 1 : 2);
  }

  // Sixteen pixels at once, where no channel is gained and the smallest may be anything: the scalar test to the last
  // bit, as levels are whole.
  bool lanes_agree() const {
    return red_gain_ == 256 && blue_gain_ == 256 && relative_ <= 256 && absolute_ <= 255 * 256 && least_ == 0;
  }
  cv::v_uint8x16 operator()(const cv::v_uint8x16& r, const cv::v_uint8x16& g, const cv::v_uint8x16& b) const {
    const cv::v_uint8x16 high = cv::v_max(cv::v_max(r, g), b);
    const cv::v_uint8x16 middle = cv::v_max(cv::v_min(r, g), cv::v_min(cv::v_max(r, g), b));
    // The share of the largest channel, rounded up to a whole level.
    cv::v_uint16x8 low_half, high_half;
    cv::v_expand(high, low_half, high_half);
    const cv::v_uint16x8 share = cv::v_setall_u16(static_cast<std::uint16_t>(relative_)), up = cv::v_setall_u16(255);
    const auto levels = [&](const cv::v_uint16x8& of) { return cv::v_shr<8>(cv::v_mul_wrap(of, share) + up); };
    const cv::v_uint8x16 needed = cv::v_max(cv::v_pack(levels(low_half), levels(high_half)),
                                            cv::v_setall_u8(static_cast<std::uint8_t>((absolute_ + 255) / 256)));
    const cv::v_uint8x16 zero = cv::v_setzero_u8(), one = cv::v_setall_u8(1), two = cv::v_setall_u8(2);
    const cv::v_uint8x16 best = cv::v_select(high == r, zero, cv::v_select(high == g, one, two));
    return cv::v_select((high - middle) >= needed, best, cv::v_setall_u8(no_ink));
  }

 private:
  int red_gain_, blue_gain_, relative_, absolute_, least_;
};

// Four pixels, `step` bytes apart, as words; reads one byte beyond the last.
cv::v_int32x4 load_words(const std::uint8_t* p, int step) {
  const auto word = [](const std::uint8_t* at) {
    int w;
    std::memcpy(&w, at, sizeof w);
    return w;
  };
  return {word(p), word(p + step), word(p + 2 * step), word(p + 3 * step)};
}

// The channels of sixteen pixels.
void load_pixels(const std::uint8_t* p, int step, cv::v_uint8x16& r, cv::v_uint8x16& g, cv::v_uint8x16& b) {
  const cv::v_int32x4 w0 = load_words(p, step), w1 = load_words(p + 4 * step, step),
                      w2 = load_words(p + 8 * step, step), w3 = load_words(p + 12 * step, step);
  const cv::v_int32x4 low = cv::v_setall_s32(255);
  const auto bytes = [&](const cv::v_int32x4& a, const cv::v_int32x4& c, const cv::v_int32x4& d,
                         const cv::v_int32x4& e) {
    return cv::v_pack_u(cv::v_pack(a & low, c & low), cv::v_pack(d & low, e & low));
  };
  using cv::v_shr;
  r = bytes(w0, w1, w2, w3);
  g = bytes(v_shr<8>(w0), v_shr<8>(w1), v_shr<8>(w2), v_shr<8>(w3));
  b = bytes(v_shr<16>(w0), v_shr<16>(w1), v_shr<16>(w2), v_shr<16>(w3));
}

}  // namespace

void segment(const ImageView& image, const SegmentationOptions& options, std::vector<std::uint8_t>& labels,
             int factor) {
  const InkTest ink(options);
  const bool lanes = ink.lanes_agree();
  const int width = image.width / factor, height = image.height / factor;
  labels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::uint8_t* out = labels.data();
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* p = image.at(factor / 2, y * factor + factor / 2);
    int x = 0;
    // A row's last pixels are read alone, as there may be nothing after them.
    for (; lanes && x + 16 < width; x += 16, p += 48 * factor, out += 16) {
      // The next row that is looked at is too far for the processor to foresee.
      if (y + 1 < height)
        for (int ahead = 0; ahead < 48 * factor; ahead += cache_line)
          __builtin_prefetch(p + static_cast<std::size_t>(factor) * image.stride + ahead);
      cv::v_uint8x16 r, g, b;
      load_pixels(p, 3 * factor, r, g, b);
      cv::v_store(out, ink(r, g, b));
    }
    for (; x < width; ++x, p += 3 * factor) *out++ = ink(p[0], p[1], p[2]);
  }
}

void peel(int width, int height, std::vector<std::uint8_t>& labels) {
  const auto w = static_cast<std::size_t>(width);
  // As they were; beyond the picture there is no ink.
  std::vector<std::uint8_t> above(w, no_ink), here(w), none(w, no_ink);
  for (int y = 0; y < height; ++y, std::swap(above, here)) {
    std::uint8_t* row = labels.data() + static_cast<std::size_t>(y) * w;
    const std::uint8_t* below = y + 1 < height ? row + w : none.data();
    std::copy(row, row + width, here.begin());
    for (std::size_t x = 0; x < w; ++x) {
      const bool inside = x > 0 && x + 1 < w && here[x - 1] == here[x] && here[x + 1] == here[x];
      if (!inside || above[x] != here[x] || below[x] != here[x]) row[x] = no_ink;
    }
  }
}

void smooth(const ImageView& image, double sigma, std::vector<std::uint8_t>& out) {
  out.resize(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const cv::Mat source(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.data), image.stride);
  cv::Mat target(image.height, image.width, CV_8UC3, out.data());
  cv::GaussianBlur(source, target, cv::Size(), sigma);
}

}  // namespace onestroke
