#pragma once

#include "golden/comparator.h"

#include <iosfwd>

namespace onestroke::golden {

/// The golden pictures: a folder with NAME.png each, and made_with.txt, which names the driver that drew them.
class Album {
 public:
  struct Folders {
    std::filesystem::path pictures;
    std::filesystem::path failures;  ///< Where a picture that is not as expected goes, to be looked at.
  };

  /// `drawn_by`: what draws here, as Gpu::name() says it. `bless`: the names of the pictures to be written instead of
  /// compared, with commas between them, or "all"; empty for none.
  /// What becomes of each blessed picture goes to `out`, which outlives the album.
  Album(Folders folders, std::string drawn_by, std::string bless, std::ostream& out);

  /// Empty where the picture is as expected. Otherwise what is wrong, and what to do about it: it looks different,
  /// there is none to compare it with, or another driver has drawn that one, which then is not compared at all. Throws
  /// Error where a file cannot be read or written.
  std::string check(const std::string& name, const Picture& actual, Tolerance tolerance) const;

 private:
  std::string bless(const std::string& name, const Picture& actual, Tolerance forgiven) const;
  std::string differs(const std::string& name, const Picture& expected, const Picture& actual,
                      const Comparison& comparison) const;
  std::filesystem::path file_of(const std::string& name) const { return folders_.pictures / (name + ".png"); }
  bool blesses(const std::string& name) const;
  std::string recorded() const;

  Folders folders_;
  std::string drawn_by_, bless_;
  std::ostream& out_;
};

/// Whether two GPUs, by their names, draw alike: the same driver in the same version on the same kind of GPU.
/// "llvmpipe (LLVM 15.0.6, 256 bits), Mesa 22.3.6 (LLVM 15.0.6)" draws like one of 128 bits, which is its processor's.
bool draw_alike(const std::string& gpu, const std::string& other);

}  // namespace onestroke::golden
