#include "app/doctor_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>

namespace onestroke {
namespace {

const std::array findings{
    Finding{.part = "Vulkan", .what = "loader 1.3.239", .needed = true},
    Finding{.part = "Vulkan", .health = Health::lacking, .what = "GPU old", .remedy = "update its driver"},
    Finding{.part = "OpenXR", .health = Health::absent, .what = "no \"runtime\"", .remedy = "install one"}};

TEST(DoctorReport, IsALineAFindingBelowEachPart) {
  EXPECT_EQ(to_text(findings), R"(Vulkan
  ok       loader 1.3.239
  lacking  GPU old: update its driver

OpenXR
  absent   no "runtime": install one

The demo can run: `onestroke run`.
)");
}

TEST(DoctorReport, SaysWhatTheDemoCannotRunWithout) {
  auto worse = findings;
  worse[0].health = Health::absent;
  worse[0].remedy = "apt install libvulkan1";
  EXPECT_TRUE(can_run(findings));
  EXPECT_FALSE(can_run(worse));
  EXPECT_THAT(
      to_text(worse),
      testing::HasSubstr("\nThe demo cannot run without:\n  absent   loader 1.3.239: apt install libvulkan1\n"));
}

TEST(DoctorReport, JsonHasTheSame) {
  const auto json = nlohmann::json::parse(to_json(findings));
  EXPECT_EQ(json["can_run"], true);
  ASSERT_EQ(json["findings"].size(), 3u);
  EXPECT_EQ(json["findings"][0]["needed"], true);
  EXPECT_FALSE(json["findings"][0].contains("remedy"));
  EXPECT_EQ(json["findings"][1]["health"], "lacking");
  EXPECT_EQ(json["findings"][2]["part"], "OpenXR");
  EXPECT_EQ(json["findings"][2]["what"], "no \"runtime\"");
}

TEST(DoctorReport, AnErrorsMessageIsPartedIntoWhatAndRemedy) {
  const Finding finding = finding_of("X", Health::absent, "it is gone: fetch it: now", true);
  EXPECT_EQ(finding.what, "it is gone");
  EXPECT_EQ(finding.remedy, "fetch it: now");
  EXPECT_TRUE(finding.needed);
  EXPECT_EQ(finding_of("X", Health::absent, "it is gone").remedy, "");
}

}  // namespace
}  // namespace onestroke
