// Prints how well two cameras tell a pose together, and each alone.

#include "score.h"
#include "stereo_set.h"

#include <cstdio>
#include <cstdlib>

namespace onestroke::accuracy {
namespace {

void print(const char* scene, const char* who, const StereoScore& s) {
  std::printf("| %s | %s | %d of %d | %d | %.3f / %.3f / %.3f | %.3f / %.3f / %.3f | %.1f |\n", scene, who, s.measured,
              s.pictures, s.wrong, quantile(s.rotation_deg, 0.5), quantile(s.rotation_deg, 0.95),
              quantile(s.rotation_deg, 1), quantile(s.position_mm, 0.5), quantile(s.position_mm, 0.95),
              quantile(s.position_mm, 1), quantile(s.nees, 0.5));
  std::fflush(stdout);
}

void print(const char* scene, const StereoScores& scores) {
  print(scene, "left alone", scores.left);
  print(scene, "right alone", scores.right);
  print(scene, "both", scores.both);
}

}  // namespace
}  // namespace onestroke::accuracy

// stereo_table [ORIENTATIONS]
int main(int count, char** words) {
  using namespace onestroke::accuracy;
  const int orientations = count > 1 ? std::atoi(words[1]) : 60;
  std::puts(
      "| scene | camera | measured | false | rotation error, degrees (median / 95 % / max) | error of the middle, mm "
      "(median / 95 % / max) | NEES (median) |\n|---|---|---|---|---|---|---|");
  print("any orientation", measure_pairs(StereoScene::any_orientation, orientations));
  print("an arm points at the left camera", measure_pairs(StereoScene::pointing, orientations));
  print("a finger covers an arm for the left camera", measure_pairs(StereoScene::covered, orientations));
}
