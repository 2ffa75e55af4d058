#include "display/world_choice.h"

#include "core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace onestroke {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// In the order in which they are chosen.
constexpr std::array worlds{World::camera, World::alpha, World::additive, World::passthrough};

/// All sixteen: bit i stands for worlds[i].
WorldOffers offers_of(unsigned bits) {
  return {
      .opaque = (bits & 1) != 0, .alpha = (bits & 2) != 0, .additive = (bits & 4) != 0, .passthrough = (bits & 8) != 0};
}

std::string refusal(unsigned bits, World wish) {
  try {
    choose_world(offers_of(bits), wish);
  } catch (const Error& error) {
    return error.what();
  }
  return "chosen";
}

TEST(WorldChoice, IsWhatWasAskedForWhereItIsOffered) {
  for (unsigned bits = 1; bits < 16; ++bits)
    for (unsigned i = 0; i < worlds.size(); ++i) {
      if (bits >> i & 1) {
        EXPECT_EQ(choose_world(offers_of(bits), worlds.at(i)), worlds.at(i)) << bits;
      }
    }
}

TEST(WorldChoice, IsByItselfTheCameraOrElseAlphaOrElseAdditive) {
  for (unsigned bits = 1; bits < 16; ++bits) {
    const World expected = bits & 1   ? World::camera
                           : bits & 2 ? World::alpha
                           : bits & 4 ? World::additive
                                      : World::passthrough;
    EXPECT_EQ(choose_world(offers_of(bits), World::automatic), expected) << bits;
  }
}

TEST(WorldChoice, RefusesWhatIsNotOfferedAndNamesWhatIs) {
  for (unsigned bits = 1; bits < 16; ++bits)
    for (unsigned i = 0; i < worlds.size(); ++i) {
      if (bits >> i & 1) continue;
      const std::string message = refusal(bits, worlds.at(i)), wish(name_of(worlds.at(i)));
      EXPECT_THAT(message, StartsWith("the headset does not offer --world " + wish + ": use --world ")) << bits;
      const std::string offered = message.substr(message.find("use"));
      for (unsigned j = 0; j < worlds.size(); ++j) {
        const std::string name(name_of(worlds.at(j)));
        if (bits >> j & 1)
          EXPECT_THAT(offered, HasSubstr(" " + name));
        else
          EXPECT_THAT(offered, Not(HasSubstr(" " + name)));
      }
    }
  EXPECT_EQ(refusal(7, World::passthrough),
            "the headset does not offer --world passthrough: use --world camera or alpha or additive");
}

TEST(WorldChoice, SaysWhereNothingIsOffered) {
  for (const World wish : {World::automatic, World::camera, World::additive})
    EXPECT_THAT(refusal(0, wish), EndsWith("update its runtime"));
}

}  // namespace
}  // namespace onestroke
