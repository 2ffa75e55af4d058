#include "catalog_folder.h"

#include <gmock/gmock.h>

namespace onestroke {
namespace {

using test::error_of;
using test::example_catalog;
using test::marker;
using test::same;
using testing::HasSubstr;

/// The example as format 1 had it, which knew of files alone.
class OldCatalogTest : public CatalogStoreTest {
 protected:
  void SetUp() override {
    CatalogStoreTest::SetUp();
    for (MarkerSpec& marker : old_.markers) marker.import = {};
    CatalogStore(file_, true).import(old_);
    sql("ALTER TABLE marker DROP COLUMN unit; ALTER TABLE marker DROP COLUMN up; ALTER TABLE marker DROP COLUMN fit;"
        "PRAGMA user_version = 1");
  }

  Catalog old_ = example_catalog();
};

TEST_F(OldCatalogTest, IsReadWithoutBeingChanged) {
  const std::string before = content(file_);
  EXPECT_TRUE(same(CatalogStore(file_).load(), old_));
  EXPECT_EQ(content(file_), before);
}

TEST_F(OldCatalogTest, IsBroughtUpToDateByTheFirstChange) {
  const Catalog more{{test::with(marker(3, "new", 1, Shape::angle(36, 4, 3, 0), "part.stl"),
                                 {.unit = LengthUnit::centimetre, .up = UpAxis::y, .fit = 55.5})}};
  CatalogStore(file_).import(more);
  Catalog all = old_;
  all.markers.insert(all.markers.begin() + 2, more.markers.front());
  EXPECT_TRUE(same(CatalogStore(file_).load(), all));
}

TEST_F(OldCatalogTest, StaysOldWhereTheChangeIsRefused) {
  EXPECT_THAT(error_of([&] { CatalogStore(file_).import(old_); }), HasSubstr("nothing was changed"));
  EXPECT_TRUE(same(CatalogStore(file_).load(), old_));
  CatalogStore(file_).import(old_, true);
  EXPECT_TRUE(same(CatalogStore(file_).load(), old_));
}

}  // namespace
}  // namespace onestroke
