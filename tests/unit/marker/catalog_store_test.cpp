#include "../core/full_disk.h"
#include "catalog_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace onestroke {
namespace {

using test::example_catalog;
using test::marker;
using test::same;
using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

TEST_F(CatalogStoreTest, KeepsWhatIsImported) {
  make();
  EXPECT_TRUE(same(CatalogStore(file_).load(), example_catalog()));
  EXPECT_TRUE(same(load_catalog(file_), example_catalog()));
}

TEST_F(CatalogStoreTest, LoadsEitherFormByItsContent) {
  write(folder_ / "catalog.db.txt", to_json(example_catalog()));
  EXPECT_TRUE(same(load_catalog(folder_ / "catalog.db.txt"), example_catalog()));
  EXPECT_THAT(error_of([&] { load_catalog(folder_ / "none.json"); }), HasSubstr("none.json cannot be read"));
  EXPECT_THAT(error_of([&] { load_catalog(folder_); }), HasSubstr("is a folder"));
  EXPECT_THAT(error_of([&] { load_catalog("/proc/self/mem"); }), HasSubstr("cannot be read"));
}

TEST_F(CatalogStoreTest, ImportsAddUp) {
  make();
  CatalogStore(file_, true).import({{marker(3, "new", 1, Shape::angle(36, 4, 3, 0))}});
  const Catalog catalog = CatalogStore(file_).load();
  EXPECT_EQ(catalog.markers.size(), 5u);
  EXPECT_EQ(catalog.markers[2].id, 3);
}

TEST_F(CatalogStoreTest, RefusesWhatIsThereAndChangesNothing) {
  make();
  const std::string before = content(file_);
  const Shape shape = Shape::angle(36, 4, 3, 0);
  CatalogStore store(file_);
  // The first entry of each import is good: it must not stay behind.
  const MarkerSpec good = marker(20, "good", 20, shape);
  EXPECT_THAT(error_of([&] {
                store.import({{good, marker(1, "other", 1, shape)}});
              }),
              AllOf(HasSubstr("marker 1 (\"other\")"), HasSubstr("id 1"), HasSubstr("--replace")));
  EXPECT_THAT(error_of([&] { store.import({{good, marker(21, "m01", 1, shape)}}); }), HasSubstr("name \"m01\""));
  EXPECT_THAT(error_of([&] {
                store.import({{good, marker(21, "other", 12345, shape)}});
              }),
              HasSubstr("first by the catalogue's marker 1 (\"m01\")"));
  EXPECT_THAT(error_of([&] { store.import({{good, good}}); }), HasSubstr("id 20 is given twice"));
  MarkerSpec unlawful = marker(21, "other", 1, shape);
  unlawful.cells.back() = CellColor::red;
  EXPECT_THAT(error_of([&] { store.import({{good, unlawful}}); }), HasSubstr("break the law"));
  EXPECT_EQ(content(file_), before);
  EXPECT_TRUE(same(store.load(), example_catalog()));
}

TEST_F(CatalogStoreTest, ReplacesByIdEvenWhereNamesChangePlaces) {
  make();
  Catalog changed = example_catalog();
  std::swap(changed.markers[0].name, changed.markers[3].name);
  std::swap(changed.markers[0].shape, changed.markers[1].shape);
  CatalogStore store(file_);
  store.import({{changed.markers[0], changed.markers[1], changed.markers[3]}}, true);
  EXPECT_TRUE(same(store.load(), changed));
}

TEST_F(CatalogStoreTest, AFailingReplacementChangesNothing) {
  make();
  const std::string before = content(file_);
  const Shape shape = Shape::angle(36, 4, 3, 0);
  EXPECT_THAT(error_of([&] { CatalogStore(file_).import({{marker(1, "bent", 77, shape)}}, true); }),
              HasSubstr("name \"bent\""));
  EXPECT_EQ(content(file_), before);
}

TEST_F(CatalogStoreTest, ReplacingAStrokeLeavesNoOldVertices) {
  make();
  CatalogStore store(file_);
  store.import({{marker(9, "stroke", 99, Shape::stroke(20, 4, 2, 0, {{0, 0, 0}, {0, 0, 80}}))}}, true);
  EXPECT_EQ(store.load().find(9)->shape.vertices().size(), 2u);
}

TEST_F(CatalogStoreTest, ReplacingAMarkerLeavesNoOldNotes) {
  make();
  CatalogStore store(file_);
  MarkerSpec again = *example_catalog().find(5);
  again.notes = {{"a", "first now"}, {"material", "6061-T6"}};
  store.import({{again}}, true);
  EXPECT_EQ(store.load().find(5)->notes, again.notes);
}

TEST_F(CatalogStoreTest, RefusesNotesThatCannotBeKept) {
  make();
  MarkerSpec twice = marker(20, "twice", 20, Shape::angle(36, 4, 3, 0), "a.stl");
  twice.notes = {{"a", "1"}, {"b", "2"}, {"a", "3"}};
  EXPECT_THAT(error_of([&] { CatalogStore(file_).import({{twice}}); }),
              AllOf(HasSubstr("marker 20 (\"twice\")"), HasSubstr("note \"a\" is given twice")));
  EXPECT_TRUE(same(CatalogStore(file_).load(), example_catalog()));
}

TEST_F(CatalogStoreTest, DoesNotMakeAFileUnlessTold) {
  EXPECT_THAT(error_of([&] { CatalogStore store(file_); }), HasSubstr("does not exist"));
  EXPECT_FALSE(fs::exists(file_));
  EXPECT_THAT(error_of([&] { CatalogStore(folder_ / "none" / "catalog.db", true); }), HasSubstr("cannot be opened"));
}

TEST_F(CatalogStoreTest, RefusesFilesThatAreNoCatalogue) {
  write(file_, "not a database, whatever its name says, and long enough to have a header");
  EXPECT_THAT(error_of([&] { CatalogStore store(file_); }), HasSubstr("is no catalogue"));
  EXPECT_THAT(error_of([&] { CatalogStore store(file_, true); }), HasSubstr("is no catalogue"));
  EXPECT_EQ(content(file_).substr(0, 14), "not a database");
  fs::remove(file_);
  sql("CREATE TABLE other (x)");
  EXPECT_THAT(error_of([&] { CatalogStore store(file_); }), HasSubstr("is no catalogue"));
  EXPECT_THAT(error_of([&] { CatalogStore store(file_, true); }), HasSubstr("is no catalogue"));
  write(file_, "");
  EXPECT_THAT(error_of([&] { CatalogStore store(file_); }), HasSubstr("is no catalogue"));
}

TEST_F(CatalogStoreTest, RefusesANewerFormat) {
  make();
  sql("PRAGMA user_version = 4");
  EXPECT_THAT(error_of([&] { CatalogStore store(file_); }), AllOf(HasSubstr("format 4"), HasSubstr("update")));
}

TEST_F(CatalogStoreTest, EveryTruncationIsSeen) {
  make();
  const std::string whole = content(file_);
  for (std::size_t size = 1; size < whole.size(); size += 509) {
    write(file_, whole.substr(0, size));
    const std::string message = error_of([&] { load_catalog(file_); });
    EXPECT_NE(message, "no error") << size << " of " << whole.size() << " bytes";
    EXPECT_THAT(message, HasSubstr(file_.string()));
  }
}

TEST_F(CatalogStoreTest, OverwrittenPagesAreSeenOrHarmless) {
  make();
  const std::string whole = content(file_);
  for (std::size_t at = 100; at < whole.size(); at += 97) {
    std::string damaged = whole;
    damaged.replace(at, std::min<std::size_t>(64, damaged.size() - at), std::min<std::size_t>(64, damaged.size() - at),
                    '\xff');
    write(file_, damaged);
    const std::string message = error_of([&] {
      const Catalog catalog = load_catalog(file_);
      if (!same(catalog, example_catalog())) throw Error(file_.string() + " differs");
    });
    EXPECT_TRUE(message == "no error" || message.starts_with(file_.string())) << message;
  }
}

TEST_F(CatalogStoreTest, EntriesThatBreakTheRulesAreNamed) {
  make();
  sql("UPDATE marker SET cells = 'RGB' || substr(cells, 4, 32) || 'R' WHERE id = 2");
  EXPECT_THAT(error_of([&] { CatalogStore(file_).load(); }),
              AllOf(HasSubstr(file_.string() + ": marker 2 (\"bent\"): "), HasSubstr("law")));
}

TEST_F(CatalogStoreTest, AFileThatMayNotBeWrittenStillLoads) {
  make();
  fs::permissions(folder_, fs::perms(0755));
  fs::permissions(file_, fs::perms(0444));
  // The owner of every file is stopped by no permission, so act as nobody then.
  const uid_t user = geteuid();
  ASSERT_TRUE(user != 0 || seteuid(65534) == 0);
  const std::string message = error_of([&] {
    CatalogStore store(file_);
    EXPECT_EQ(store.load().markers.size(), 4u);
    store.import({{marker(3, "new", 1, Shape::angle(36, 4, 3, 0))}});
  });
  ASSERT_TRUE(user != 0 || seteuid(0) == 0);
  EXPECT_THAT(message, AllOf(HasSubstr(file_.string()), HasSubstr("may not be written"), HasSubstr("permissions")));
}

TEST_F(CatalogStoreTest, AFullDiskChangesNothing) {
  make();
  const std::string before = content(file_);
  Catalog many;
  for (int i = 0; i < 400; ++i)
    many.markers.push_back(
        marker(100 + i, "many" + std::to_string(i), 1000 + static_cast<std::uint64_t>(i), Shape::angle(36, 4, 3, 0)));
  std::string message;
  {
    CatalogStore store(file_);
    const FullDisk full(before.size() + 4096);
    message = error_of([&] { store.import(many); });
  }
  EXPECT_THAT(message, AllOf(HasSubstr(file_.string()), HasSubstr("disk")));
  EXPECT_TRUE(same(CatalogStore(file_).load(), example_catalog()));
}

TEST_F(CatalogStoreTest, AFullDiskLeavesNoNewFile) {
  std::string message;
  {
    const FullDisk full(4096);
    message = error_of([&] { CatalogStore store(file_, true); });
  }
  EXPECT_THAT(message, HasSubstr("disk"));
  EXPECT_FALSE(fs::exists(file_));
}

TEST_F(CatalogStoreTest, WaitsForNobodyForEver) {
  make();
  sqlite3* other = nullptr;
  ASSERT_EQ(sqlite3_open(file_.c_str(), &other), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(other, "BEGIN EXCLUSIVE", nullptr, nullptr, nullptr), SQLITE_OK);
  EXPECT_THAT(error_of([&] { CatalogStore(file_).load(); }), HasSubstr("in use by another program"));
  sqlite3_close(other);
  EXPECT_TRUE(same(CatalogStore(file_).load(), example_catalog()));
}

TEST_F(CatalogStoreTest, MovesLikeAHandle) {
  make();
  CatalogStore first(file_);
  CatalogStore second = std::move(first);
  EXPECT_EQ(second.load().markers.size(), 4u);
  first = std::move(second);
  EXPECT_EQ(first.load().markers.size(), 4u);
}

}  // namespace
}  // namespace onestroke
