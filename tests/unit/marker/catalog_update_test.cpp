#include "catalog_folder.h"

#include <gmock/gmock.h>

namespace onestroke {
namespace {

using test::example_catalog;
using test::marker;
using test::same;
using testing::HasSubstr;

/// The example as an older format had it: 1 knew of files alone, 2 how to read them, but not what is said of the
/// models.
class OldCatalogTest : public CatalogStoreTest, public testing::WithParamInterface<int> {
 protected:
  void SetUp() override {
    CatalogStoreTest::SetUp();
    for (MarkerSpec& marker : old_.markers) {
      if (GetParam() < 2) marker.import = {};
      marker.model_name = marker.version = {};
      marker.notes.clear();
    }
    CatalogStore(file_, true).import(old_);
    sql("DROP TABLE note; ALTER TABLE marker DROP COLUMN model_name; ALTER TABLE marker DROP COLUMN version;"
        "PRAGMA user_version = 2");
    if (GetParam() < 2)
      sql("ALTER TABLE marker DROP COLUMN unit; ALTER TABLE marker DROP COLUMN up; ALTER TABLE marker DROP COLUMN fit;"
          "PRAGMA user_version = 1");
  }

  Catalog old_ = example_catalog();
};

TEST_P(OldCatalogTest, IsReadWithoutBeingChanged) {
  const std::string before = content(file_);
  EXPECT_TRUE(same(CatalogStore(file_).load(), old_));
  EXPECT_EQ(content(file_), before);
}

TEST_P(OldCatalogTest, IsBroughtUpToDateByTheFirstChange) {
  const Catalog more{{test::with(test::told_of(marker(3, "new", 1, Shape::angle(36, 4, 3, 0), "part.stl")),
                                 {.unit = LengthUnit::centimetre, .up = UpAxis::y, .fit = 55.5})}};
  CatalogStore(file_).import(more);
  Catalog all = old_;
  all.markers.insert(all.markers.begin() + 2, more.markers.front());
  EXPECT_TRUE(same(CatalogStore(file_).load(), all));
}

TEST_P(OldCatalogTest, StaysOldWhereTheChangeIsRefused) {
  EXPECT_THAT(error_of([&] { CatalogStore(file_).import(old_); }), HasSubstr("nothing was changed"));
  EXPECT_TRUE(same(CatalogStore(file_).load(), old_));
  CatalogStore(file_).import(old_, true);
  EXPECT_TRUE(same(CatalogStore(file_).load(), old_));
}

INSTANTIATE_TEST_SUITE_P(Formats, OldCatalogTest, testing::Values(1, 2));

}  // namespace
}  // namespace onestroke
