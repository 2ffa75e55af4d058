#include "core/model_import.h"

#include <gtest/gtest.h>

namespace onestroke {
namespace {

TEST(ModelImport, WordsAndValuesBelongTogether) {
  for (const std::string_view word : length_unit_words) EXPECT_EQ(word_of(length_unit_of(word).value()), word);
  for (const std::string_view word : up_axis_words) EXPECT_EQ(word_of(up_axis_of(word).value()), word);
  EXPECT_FALSE(length_unit_of("MM"));
  EXPECT_FALSE(length_unit_of(""));
  EXPECT_FALSE(up_axis_of("-z"));
}

TEST(ModelImport, UnitsHaveTheirLengths) {
  EXPECT_EQ(metres_of(LengthUnit::metre), 1);
  EXPECT_EQ(metres_of(LengthUnit::centimetre), 0.01);
  EXPECT_EQ(metres_of(LengthUnit::millimetre), 0.001);
  EXPECT_DOUBLE_EQ(12 * metres_of(LengthUnit::inch), metres_of(LengthUnit::foot));
  EXPECT_EQ(metres_of(LengthUnit::inch), 0.0254);
}

TEST(ModelImport, IsSaidInWords) {
  EXPECT_EQ(words_of({}), "");
  EXPECT_EQ(words_of({LengthUnit::inch, UpAxis::z, 62.5}), ", in, z up, fit 62.5 mm");
  EXPECT_EQ(words_of({.fit = 60}), ", fit 60 mm");
}

}  // namespace
}  // namespace onestroke
