#include "app/doctor_command.h"

#include "app/cache_folder.h"
#include "app/doctor_report.h"
#include "app/head_mount.h"
#include "app/say.h"
#include "camera/libcamera_source.h"
#include "core/error.h"
#include "display/headset_survey.h"
#include "display/window.h"
#include "marker/catalog.h"
#include "render/gpu_survey.h"

#include <algorithm>
#include <cstdlib>
#include <ostream>

namespace onestroke {
namespace {

namespace fs = std::filesystem;
using Findings = std::vector<Finding>;

void look_at_gpus(Findings& findings) {
  const std::string part = "Vulkan";
  const GpuSurvey survey = survey_gpus();
  if (!survey.loader.empty()) findings.push_back({.part = part, .what = "loader " + survey.loader, .needed = true});
  if (!survey.failure.empty()) findings.push_back(finding_of(part, Health::absent, survey.failure, true));
  bool usable = false;
  for (const GpuSurvey::Device& device : survey.devices) {
    const std::string what = "GPU " + device.name + ", driver " + device.driver + ", Vulkan " + device.api;
    usable = usable || device.lacking.empty();
    if (device.lacking.empty())
      findings.push_back({.part = part, .what = what});
    else
      findings.push_back({.part = part,
                          .health = Health::lacking,
                          .what = what + "; " + device.lacking,
                          .remedy = "update its driver"});
  }
  if (survey.failure.empty() && !usable)
    findings.push_back({.part = part,
                        .health = Health::absent,
                        .what = "a GPU that can be used",
                        .remedy = "apt install mesa-vulkan-drivers or the GPU's driver",
                        .needed = true});
  if (survey.loader.empty()) return;
  if (survey.validation)
    findings.push_back({.part = part, .what = "validation layer, which ONESTROKE_VALIDATION=1 turns on"});
  else
    findings.push_back({.part = part,
                        .health = Health::absent,
                        .what = "validation layer, for who writes programs alone",
                        .remedy = "apt install vulkan-validationlayers"});
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

void look_at_extensions(const HeadsetSurvey& survey, Findings& findings) {
  for (const HeadsetSurvey::Extension& extension : survey.extensions) {
    Finding finding{.part = "OpenXR", .what = extension.name};
    if (!extension.offered) {
      finding.health = Health::absent;
      finding.remedy = extension.needed ? "no headset without it, update the runtime or make another one active"
                                        : "without it " + extension.lost;
    }
    findings.push_back(finding);
  }
}

void look_at_headset(const HeadsetSurvey::Headset& headset, Findings& findings) {
  const std::string part = "Headset";
  const auto add = [&](bool good, const std::string& what, const std::string& remedy) {
    findings.push_back({.part = part,
                        .health = good ? Health::ok : Health::lacking,
                        .what = what,
                        .remedy = good ? std::string() : remedy});
  };
  add(headset.width > 0,
      headset.name + ", " + std::to_string(headset.width) + " x " + std::to_string(headset.height) + " pixels an eye",
      "it shows no pair of views, use another");
  add(!headset.blend_modes.empty(), "shows the world: " + joined(headset.blend_modes),
      "it does not say how, update its runtime");
  add(headset.orientation,
      headset.orientation ? "follows how the head turns" : "does not say that it follows how the head turns",
      "it may all the same, as the poses of a session tell");
  add(headset.position,
      headset.position ? "follows where the head is" : "does not say that it follows where the head is",
      "it may all the same, as the poses of a session tell");
  add(headset.hands, headset.hands ? "follows hands" : "follows no hands", "the sticks do without");
}

void look_at_manifest(const std::string& manifest, Findings& findings) {
  std::error_code unknown;
  Finding finding{.part = "OpenXR", .what = "runtime's manifest " + manifest};
  if (!fs::exists(manifest, unknown)) {
    finding.health = Health::absent;
    finding.remedy = manifest.empty() ? "name one in XR_RUNTIME_JSON, or in ~/.config/openxr/1/active_runtime.json"
                                      : "name one that is there in XR_RUNTIME_JSON";
  }
  if (manifest.empty()) finding.what = "the active runtime's manifest";
  findings.push_back(std::move(finding));
}

void look_at_openxr(Findings& findings) {
  const std::string part = "OpenXR";
  const HeadsetSurvey survey = survey_headset();
  findings.push_back({.part = part, .what = "loader " + survey.loader});
  look_at_manifest(survey.manifest, findings);
  if (!survey.runtime.empty()) findings.push_back({.part = part, .what = "runtime " + survey.runtime});
  look_at_extensions(survey, findings);
  if (!survey.failure.empty())
    findings.push_back(finding_of(survey.runtime.empty() ? part : "Headset", Health::absent, survey.failure));
  if (!survey.headset) return;
  look_at_headset(*survey.headset, findings);
}

void look_at_displays(Findings& findings) {
  const std::string part = "Displays";
  const std::string lacking = window_shortfall();
  if (lacking.empty())
    findings.push_back({.part = part, .what = "--display window"});
  else
    findings.push_back(finding_of(part, Health::absent, "--display window, " + lacking));
  findings.push_back({.part = part, .what = "--display offscreen:DIR"});
}

Finding no_camera(const std::string& part) {
  Finding finding{
      .part = part, .health = Health::absent, .what = "a camera that is connected", .remedy = "plug one in"};
  if (const std::string node = forbidden_camera(); !node.empty()) {
    finding.what += ", for this user may not open " + node;
    finding.remedy = "add yourself to the group video and log in again";
  }
  return finding;
}

/// What it is asked for without further options, and how often each picture's bytes are written before they are
/// tracked.
void look_at_camera(const CameraListing& camera, Findings& findings) {
  const std::string part = "Cameras", what = "--camera libcamera:\"" + camera.model + "\", id " + camera.id;
  if (!camera.unusable.empty())
    return findings.push_back(finding_of(part, Health::lacking, what + ", " + camera.unusable));
  const FormatChoice& usual = camera.usual;
  findings.push_back({.part = part,
                      .what = what + ", usually " + std::to_string(usual.size.width) + " x " +
                              std::to_string(usual.size.height) + " " + usual.name + ", " +
                              copies_words(usual.coding)});
  std::string formats;
  for (const OfferedFormat& format : camera.formats) {
    formats += (formats.empty() ? "" : "; ") + format.name;
    for (const PictureSize& size : format.sizes)
      formats += " " + std::to_string(size.width) + "x" + std::to_string(size.height);
  }
  findings.push_back({.part = part, .what = camera.model + " has " + formats});
  const bool exposure = std::ranges::find(camera.controls, "ExposureTime") != camera.controls.end();
  findings.push_back({.part = part,
                      .health = exposure ? Health::ok : Health::lacking,
                      .what = camera.model + (exposure ? " lets its exposure be fixed" : " fixes no exposure"),
                      .remedy = exposure ? "" : "use bright light, in which its automatic exposes shortly"});
}

void look_at_cameras(Findings& findings) {
  const std::string part = "Cameras";
  for (const char* spec : {"--camera synthetic", "--camera folder:DIR", "--camera file:VIDEO"})
    findings.push_back({.part = part, .what = spec});
  findings.push_back({.part = part, .what = "libcamera " + libcamera_version()});
  const std::vector<CameraListing> cameras = list_cameras();
  if (cameras.empty()) findings.push_back(no_camera(part));
  for (const CameraListing& camera : cameras) look_at_camera(camera, findings);
}

void look_at_catalog(Findings& findings) {
  const std::string part = "Files";
  const fs::path file = assets_folder() / "catalog.json";
  const auto missing = [&](const std::string& what) {
    findings.push_back({.part = part,
                        .health = Health::absent,
                        .what = what,
                        .remedy = "set ONESTROKE_ASSETS to the folder that holds it",
                        .needed = true});
  };
  std::error_code unknown;
  if (!fs::exists(file, unknown)) return missing("the demo's catalogue " + file.string());
  const Catalog catalog = load_catalog(file);
  findings.push_back(
      {.part = part,
       .what = "the demo's catalogue " + file.string() + ", " + std::to_string(catalog.markers.size()) + " markers",
       .needed = true});
  for (const MarkerSpec& marker : catalog.markers)
    if (const fs::path model = file.parent_path() / marker.model; !marker.model.empty() && !fs::exists(model, unknown))
      missing("the model " + model.string());
}

void look_at_mounts(Findings& findings) {
  const std::string part = "Files";
  const fs::path own = mounts_file();
  std::error_code unknown;
  if (!own.empty() && fs::exists(own, unknown)) {
    find_mount({}, {});
    findings.push_back({.part = part, .what = "your headsets' cameras " + own.string()});
  } else {
    findings.push_back({.part = part,
                        .health = Health::absent,
                        .what = "calibrations of your headsets' cameras",
                        .remedy = "`onestroke calibrate head` makes them"});
  }
}

/// Runs one look; what it cannot bear is a finding too.
void look(Findings& findings, const char* part, void (*at)(Findings&), bool needed) {
  try {
    at(findings);
  } catch (const std::exception& error) {
    findings.push_back(finding_of(part, Health::lacking, error.what(), needed));
  }
}

}  // namespace

int doctor_command(const DoctorOptions& options, std::ostream& out) {
  // The loader has words of its own for what is said here.
  setenv("XR_LOADER_DEBUG", "none", 0);
  Findings findings;
  look(findings, "Vulkan", look_at_gpus, true);
  look(findings, "Displays", look_at_displays, false);
  look(findings, "OpenXR", look_at_openxr, false);
  look(findings, "Cameras", look_at_cameras, true);
  look(findings, "Files", look_at_catalog, true);
  look(findings, "Files", look_at_mounts, false);
  out << (options.json ? to_json(findings) : to_text(findings));
  end_output(out);
  return can_run(findings) ? 0 : 1;
}

}  // namespace onestroke
