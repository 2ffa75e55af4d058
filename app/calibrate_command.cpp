#include "app/calibrate_command.h"

#include "app/clock_sights.h"
#include "app/head_mount.h"
#include "app/head_recording.h"
#include "app/head_sights.h"
#include "app/say.h"
#include "core/error.h"

#include <array>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <ostream>

namespace onestroke {
namespace {

constexpr const char* unseen =
    "no marker of the catalogue was seen with the head's pose known: lay one down in sight, in good light";

std::string now_utc() {
  const std::time_t now = std::time(nullptr);
  std::tm t{};
  gmtime_r(&now, &t);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &t);
  return text.data();
}

template <typename... Numbers>
void print(std::ostream& out, const char* format, Numbers... numbers) {
  std::array<char, 256> line{};
  std::snprintf(line.data(), line.size(), format, numbers...);
  out << line.data() << '\n';
}

void print(std::ostream& out, const HeadCalibration& c) {
  const Vec3 &t = c.T_head_camera.translation, mm = c.deviation_mm, deg = c.deviation_deg;
  const Vec3 turned = (180 / std::numbers::pi) * log_so3(c.T_head_camera.rotation);
  const HeadResiduals& r = c.residuals;
  out << "the camera in the head, to the right, down and forward:\n";
  print(out, "  at      %8.2f %8.2f %8.2f mm       +- %.2f %.2f %.2f", t.x, t.y, t.z, mm.x, mm.y, mm.z);
  print(out, "  turned  %8.3f %8.3f %8.3f degrees  +- %.3f %.3f %.3f", turned.x, turned.y, turned.z, deg.x, deg.y,
        deg.z);
  print(out,
        "from %zu sights, the head turned by %.0f and %.0f degrees about two axes; %zu left out as outliers, %zu alike",
        c.used, c.turn.first_deg, c.turn.second_deg, c.outliers, c.alike);
  print(out, "residuals, rms and worst: %.3f and %.3f degrees, %.2f and %.2f mm", r.rms_deg, r.worst_deg, r.rms_mm,
        r.worst_mm);
  if (r.worst_px > 0) print(out, "in the picture: %.2f and %.2f px", r.rms_px, r.worst_px);
}

void calibrate_head(const CalibrateOptions& options, std::ostream& out) {
  HeadSights sights;
  const HeadRecording recording = record_sights(options, sights);
  if (sights.seen() == 0) throw Error(unseen);
  const MountReport report{.calibration = calibrate_head(sights.sights(), recording.focal_px),
                           .headset = recording.headset,
                           .camera = recording.camera,
                           .date = now_utc()};
  print(out, report.calibration);
  write_mount(options.output, report);
  out << "wrote " << options.output.string() << "; `onestroke run --head-camera` takes it\n";
  if (report.headset.empty()) return;
  keep_mount(report);
  out << "kept in " << mounts_file().string() << " for " << report.headset << ", where `onestroke run` finds it\n";
}

void calibrate_clock(const CalibrateOptions& options, std::ostream& out) {
  ClockSights sights;
  const HeadRecording recording = record_sights(options, sights);
  if (sights.seen() == 0) throw Error(unseen);
  const ClockOffset found = find_clock_offset(sights.sights(), recording.focal_px);
  const double already = options.source.live.clock_offset.ms();
  print(out, "the light of a picture was gathered %.2f +- %.2f ms later than its time says (negative: earlier)",
        found.offset.ms(), found.deviation.ms());
  print(out, "from %zu pictures; rms of what is left: %.3f degrees, %.2f px", found.used, found.residual_deg,
        found.residual_px);
  print(out, "give --clock-offset-ms %.2f with this camera and this exposure", found.offset.ms() + already);
}

}  // namespace

int calibrate_command(const CalibrateOptions& options, std::ostream& out) {
  if (options.what == CalibrateOptions::What::clock)
    calibrate_clock(options, out);
  else
    calibrate_head(options, out);
  end_output(out);
  return 0;
}

}  // namespace onestroke
