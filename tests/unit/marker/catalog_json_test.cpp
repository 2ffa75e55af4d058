#include "example_catalog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace onestroke {
namespace {

using test::example_catalog;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* angle = R"({"kind": "angle", "cells": 6, "pitch": 4.0, "radius": 3.0, "bend_radius": 0})";

std::string entry(const std::string& id, const std::string& name, const std::string& code, const std::string& shape,
                  const std::string& rest = "") {
  return R"({"id": )" + id + R"(, "name": )" + name + ", " + code + R"(, "shape": )" + shape + rest + "}";
}

std::string list(const std::string& entries) {
  return R"({"markers": [)" + entries + "]}";
}

const std::string good = entry("1", R"("m01")", R"("cells": "RGBRGB")", angle);

/// The message for a catalogue whose second entry is this one.
std::string second_is(const std::string& bad) {
  return error_of([&] { catalog_from_json(list(good + "," + bad), "catalog.json"); });
}

std::string second_with(const std::string& code, const std::string& shape = angle) {
  return second_is(entry("2", R"("m02")", code, shape));
}

std::string second_shaped(const std::string& shape) {
  return second_with(R"("cells": "RBGRBG")", shape);
}

TEST(CatalogJson, ReadsTheExchangeForm) {
  const Catalog catalog = catalog_from_json(
      R"({"markers": [{"id": 4, "name": "m04", "cells": "RGBRGB", "model": "x.glb",
          "shape": {"kind": "angle", "cells": 6, "pitch": 4.0, "radius": 3.0, "bend_radius": 8.0}}]})",
      "catalog.json");
  ASSERT_EQ(catalog.markers.size(), 1u);
  const MarkerSpec* marker = catalog.find(4);
  ASSERT_NE(marker, nullptr);
  EXPECT_EQ(catalog.find(1), nullptr);
  EXPECT_EQ(marker->name, "m04");
  EXPECT_EQ(to_letters(marker->cells), "RGBRGB");
  EXPECT_EQ(marker->model, "x.glb");
  EXPECT_EQ(marker->shape.kind(), Shape::Kind::angle);
  EXPECT_EQ(marker->shape.bend_radius(), 8);
}

const MarkerSpec& carrying(Catalog& catalog, const std::string& model) {
  catalog = catalog_from_json(list(entry("1", R"("m01")", R"("cells": "RGBRGB")", angle, R"(, "model": )" + model)),
                              "catalog.json");
  return catalog.markers.front();
}

std::string second_carrying(const std::string& model) {
  return second_is(entry("2", R"("m02")", R"("cells": "RBGRBG")", angle, R"(, "model": )" + model));
}

TEST(CatalogJson, AModelIsAFileOrAnObjectThatSaysMore) {
  Catalog catalog;
  EXPECT_EQ(carrying(catalog, R"("part.stl")").import, ModelImport{});
  EXPECT_EQ(carrying(catalog, R"({"file": "part.stl"})").model, "part.stl");
  EXPECT_EQ(carrying(catalog, R"({"file": "part.stl"})").import, ModelImport{});
  EXPECT_EQ(carrying(catalog, R"({"file": "part.stl", "unit": "in", "up": "z", "fit": 60})").import,
            (ModelImport{LengthUnit::inch, UpAxis::z, 60}));
  for (const std::string_view word : length_unit_words)
    EXPECT_EQ(word_of(*carrying(catalog, R"({"file": "a", "unit": ")" + std::string(word) + "\"}").import.unit), word);
  for (const std::string_view word : up_axis_words)
    EXPECT_EQ(word_of(*carrying(catalog, R"({"file": "a", "up": ")" + std::string(word) + "\"}").import.up), word);
  EXPECT_THAT(to_json(catalog), HasSubstr(R"("model":{"file":"a","up":"z"})"));
}

TEST(CatalogJson, WrongWordsOfAModelAreAnsweredWithTheRightOnes) {
  EXPECT_THAT(
      second_carrying(R"({"file": "a", "unit": "metre"})"),
      AllOf(HasSubstr("marker 2"), HasSubstr(R"("unit" is "metre"; it must be "m", "cm", "mm", "in" or "ft")")));
  EXPECT_THAT(second_carrying(R"({"file": "a", "up": "up"})"),
              HasSubstr(R"("up" is "up"; it must be "x", "y" or "z")"));
  EXPECT_THAT(second_carrying(R"({"unit": "m"})"), HasSubstr("\"file\" is missing"));
  EXPECT_THAT(second_carrying(R"({"file": "a", "size": 3})"), HasSubstr("\"size\" is unknown"));
  EXPECT_THAT(second_carrying("7"), HasSubstr("must be a text, or an object with \"file\""));
  EXPECT_THAT(second_carrying(R"({"file": "", "fit": 60})"), HasSubstr("there is no model"));
  for (const char* fit : {"0", "-5", "10001", "\"big\""})
    EXPECT_THAT(second_carrying(R"({"file": "a", "fit": )" + std::string(fit) + "}"), HasSubstr("\"fit\" must be"));
}

TEST(CatalogJson, AModelHasANameAVersionAndNotesInTheirOrder) {
  Catalog catalog;
  const MarkerSpec& part = carrying(catalog, R"({"notes": {"material": "6061-T6", "changed": "ribs", "a": ""},
                                                 "version": "v2", "name": "Bracket", "file": "a"})");
  EXPECT_EQ(part.model_name, "Bracket");
  EXPECT_EQ(part.version, "v2");
  const std::vector<ModelNote> notes{{"material", "6061-T6"}, {"changed", "ribs"}, {"a", ""}};
  EXPECT_EQ(part.notes, notes);
  EXPECT_THAT(to_json(catalog), HasSubstr(R"("model":{"file":"a","name":"Bracket","version":"v2",)"
                                          R"("notes":{"material":"6061-T6","changed":"ribs","a":""}})"));
  carrying(catalog, R"({"file": "a", "name": "", "version": "", "notes": {}})");
  EXPECT_THAT(to_json(catalog), HasSubstr(R"("model":"a"})")) << "what is not said is not written";
}

std::string second_noted(const std::string& notes) {
  return second_carrying(R"({"file": "a", "notes": )" + notes + "}");
}

std::string notes_of(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += (i == 0 ? "{\"" : ", \"") + std::to_string(i) + "\": \"\"";
  return text + "}";
}

TEST(CatalogJson, NotesThatCannotBeShownAreRefused) {
  EXPECT_THAT(second_noted(R"({"mass": 79})"),
              AllOf(HasSubstr("marker 2 (\"m02\")"), HasSubstr("note \"mass\" must be a text, not number")));
  EXPECT_THAT(second_noted(R"(["6061-T6"])"), HasSubstr("\"notes\" must be an object, not array"));
  EXPECT_THAT(second_noted(R"({"": "x"})"), HasSubstr("empty key"));
  EXPECT_THAT(second_noted(R"({"a": "x\ny"})"), HasSubstr("note \"a\" contains a control character"));
  EXPECT_THAT(second_noted(R"({"b": "", "a\u001b": "x"})"), HasSubstr("note 2 contains a control character"));
  EXPECT_THAT(second_noted(R"({"a": "1", "a": "2"})"), HasSubstr("\"a\" is given twice"));
  EXPECT_THAT(second_noted(R"({"a": ")" + std::string(201, 'x') + "\"}"), HasSubstr("longer than 200 bytes"));
  EXPECT_EQ(second_noted(R"({"a": ")" + std::string(200, 'x') + "\"}"), "no error");
  EXPECT_THAT(second_noted(notes_of(33)), AllOf(HasSubstr("33 notes"), HasSubstr("at most 32")));
  EXPECT_EQ(second_noted(notes_of(32)), "no error");
}

TEST(CatalogJson, NamesAndVersionsThatCannotBeShownAreRefused) {
  EXPECT_THAT(second_carrying(R"({"file": "a", "version": 2})"), HasSubstr("\"version\" must be a text, not number"));
  EXPECT_THAT(second_carrying(R"({"file": "a", "version": "\t"})"),
              HasSubstr("the model's version contains a control"));
  EXPECT_THAT(second_carrying(R"({"file": "a", "name": ")" + std::string(201, 'x') + "\"}"),
              HasSubstr("the model's name is longer than 200"));
  EXPECT_THAT(second_carrying(R"({"file": "", "version": "v2"})"), HasSubstr("there is no model"));
}

TEST(CatalogJson, RoundTripIsByteForByteStable) {
  const std::string once = to_json(example_catalog());
  const std::string twice = to_json(catalog_from_json(once, "catalog.json"));
  EXPECT_EQ(once, twice);
  EXPECT_EQ(std::ranges::count(once, '\n'), 6);
}

TEST(CatalogJson, NumbersComeBackExactly) {
  const Catalog catalog = catalog_from_json(to_json(example_catalog()), "catalog.json");
  EXPECT_EQ(catalog.find(5)->shape.pitch(), 1.0 / 3);
  EXPECT_EQ(catalog.find(9)->shape.vertices(), example_catalog().find(9)->shape.vertices());
  EXPECT_EQ(catalog.find(5)->name, "Größe \"5\"");
}

TEST(CatalogJson, EmptyCatalogueIsOne) {
  EXPECT_TRUE(catalog_from_json(list(""), "catalog.json").markers.empty());
  EXPECT_EQ(to_json({}), "{\"markers\": [\n]}\n");
}

TEST(CatalogJson, SortsById) {
  const Catalog catalog =
      catalog_from_json(list(entry("7", R"("b")", R"("value": 3)", angle) + "," + good), "catalog.json");
  EXPECT_EQ(catalog.markers[0].id, 1);
  EXPECT_EQ(catalog.markers[1].id, 7);
}

TEST(CatalogJson, TakesAValueForTheCells) {
  const Catalog catalog = catalog_from_json(list(entry("1", R"("a")", R"("value": 13)", angle)), "catalog.json");
  EXPECT_EQ(catalog.markers[0].cells, encode(13, 6));
}

TEST(CatalogJson, TakesAStopCellOfEitherColourAfterRed) {
  EXPECT_EQ(second_with(R"("cells": "RBGBRG")"), "no error");
  EXPECT_EQ(second_with(R"("cells": "RBGBRB")"), "no error");
}

TEST(CatalogJson, NamesTheFileAndTheEntry) {
  EXPECT_THAT(second_with(R"("cells": "GBRGBG")"), StartsWith("catalog.json: marker 2 (\"m02\"): "));
  EXPECT_THAT(second_is("3"), StartsWith("catalog.json: marker 2: "));
}

TEST(CatalogJson, RefusesCellsThatBreakTheLaw) {
  EXPECT_THAT(second_with(R"("cells": "GBRGBG")"), HasSubstr("first cell is green"));
  EXPECT_THAT(second_with(R"("cells": "RGGRGB")"), HasSubstr("cells 2 and 3 are both green"));
  EXPECT_THAT(second_with(R"("cells": "RGBRBR")"), HasSubstr("last cell is red"));
  EXPECT_THAT(second_with(R"("cells": "RGYRBG")"), HasSubstr("cell 3 is 'Y'"));
  EXPECT_THAT(second_with(R"("cells": "RGBRG")"), HasSubstr("has 5 cells but the shape 6"));
  EXPECT_THAT(second_with(R"("cells": "")"), HasSubstr("not 0"));
}

TEST(CatalogJson, RefusesWhatIsGivenTwice) {
  EXPECT_THAT(second_is(entry("1", R"("m02")", R"("cells": "RBGRBG")", angle)),
              HasSubstr("id 1 is given twice, first by marker 1 (\"m01\")"));
  EXPECT_THAT(second_is(entry("2", R"("m01")", R"("cells": "RBGRBG")", angle)),
              HasSubstr("name \"m01\" is given twice"));
  EXPECT_THAT(second_with(R"("cells": "RGBRGB")"), HasSubstr("code RGBRGB is given twice"));
  EXPECT_THAT(second_with(R"("value": 0)"), HasSubstr("code RGBRGB is given twice"));
  // Read from its other end a code is the same code, and never a lawful one.
  EXPECT_THAT(second_with(R"("cells": "BGRBGR")"), HasSubstr("first cell is blue"));
  // Two codes that differ in the stop cell alone carry the same value.
  const std::string stop_green = entry("1", R"("a")", R"("cells": "RBGBRG")", angle);
  const std::string stop_blue = entry("2", R"("b")", R"("cells": "RBGBRB")", angle);
  EXPECT_THAT(error_of([&] { catalog_from_json(list(stop_green + "," + stop_blue), "f"); }), HasSubstr("given twice"));
  EXPECT_THAT(second_is(R"({"id": 2, "id": 3})"), HasSubstr("key \"id\" is given twice in one object"));
}

TEST(CatalogJson, RefusesUnknownKeys) {
  EXPECT_THAT(second_is(entry("2", R"("m02")", R"("cells": "RBGRBG")", angle, R"(, "colour": 1)")),
              HasSubstr("marker 2 (\"m02\"): key \"colour\" is unknown"));
  EXPECT_THAT(second_shaped(R"({"kind": "line", "cells": 6, "pitch": 4, "radius": 3, "bend_radius": 0})"),
              HasSubstr("key \"bend_radius\" is unknown"));
  EXPECT_THAT(error_of([] { catalog_from_json(R"({"markers": [], "version": 1})", "f.json"); }),
              HasSubstr("f.json: key \"version\" is unknown"));
}

TEST(CatalogJson, RefusesMissingKeys) {
  EXPECT_THAT(second_is(R"({"name": "m02"})"), HasSubstr("marker 2 (\"m02\"): key \"id\" is missing"));
  EXPECT_THAT(second_is(R"({"id": 2})"), HasSubstr("key \"name\" is missing"));
  EXPECT_THAT(second_is(R"({"id": 2, "name": "m02"})"), HasSubstr("key \"shape\" is missing"));
  EXPECT_THAT(second_with(R"("model": "x")"), HasSubstr("give either \"cells\" or \"value\""));
  EXPECT_THAT(second_with(R"("cells": "RBGRBG", "value": 3)"), HasSubstr("give either"));
  for (const std::string key : {"kind", "cells", "pitch", "radius", "bend_radius"}) {
    std::string shape = angle;
    shape.replace(shape.find(key), key.size(), "x");
    EXPECT_THAT(second_shaped(shape), HasSubstr("key \"" + key + "\" is missing"));
  }
  EXPECT_THAT(second_shaped(R"({"kind": "stroke", "cells": 6, "pitch": 4, "radius": 3, "bend_radius": 0})"),
              HasSubstr("key \"vertices\" is missing"));
  EXPECT_THAT(error_of([] { catalog_from_json("{}", "f.json"); }), HasSubstr("key \"markers\" is missing"));
}

TEST(CatalogJson, RefusesWrongTypes) {
  EXPECT_THAT(second_is("[]"), HasSubstr("must be an object, not array"));
  EXPECT_THAT(second_is(entry("\"2\"", R"("m02")", R"("value": 3)", angle)),
              HasSubstr("\"id\" must be a whole number"));
  EXPECT_THAT(second_is(entry("2.5", R"("m02")", R"("value": 3)", angle)), HasSubstr("\"id\" must be a whole number"));
  EXPECT_THAT(second_is(entry("2", "2", R"("value": 3)", angle)), HasSubstr("\"name\" must be a text, not number"));
  EXPECT_THAT(second_with(R"("cells": ["R"])"), HasSubstr("\"cells\" must be a text"));
  EXPECT_THAT(second_with(R"("value": -1)"), HasSubstr("\"value\" must be a whole number"));
  EXPECT_THAT(second_with(R"("value": "1")"), HasSubstr("\"value\" must be a whole number"));
  EXPECT_THAT(second_with(R"("value": 3, "model": null)"),
              HasSubstr("\"model\" must be a text, or an object with \"file\", not null"));
  EXPECT_THAT(second_shaped("\"angle\""), HasSubstr("\"shape\" must be an object"));
  EXPECT_THAT(second_shaped(R"({"kind": "ring"})"), HasSubstr("\"ring\"; it must be \"angle\""));
  EXPECT_THAT(error_of([] { catalog_from_json("[]", "f.json"); }), HasSubstr("must be an object, not array"));
  EXPECT_THAT(error_of([] { catalog_from_json(R"({"markers": {}})", "f.json"); }), HasSubstr("must be a list"));
}

TEST(CatalogJson, RefusesBadVertices) {
  const std::string head = R"({"kind": "stroke", "cells": 6, "pitch": 4, "radius": 1, "bend_radius": 0, "vertices": )";
  EXPECT_EQ(second_shaped(head + "[[0, 0, 0], [24, 0, 0]]}"), "no error");
  EXPECT_THAT(second_shaped(head + "7}"), HasSubstr("must be a list of [x, y, z]"));
  EXPECT_THAT(second_shaped(head + "[[0, 0], [24, 0]]}"), HasSubstr("must be [x, y, z]"));
  EXPECT_THAT(second_shaped(head + R"([[0, 0, "0"], [24, 0, 0]]})"), HasSubstr("must be a number, not string"));
  EXPECT_THAT(second_shaped(head + "[[0, 0, 0], [25, 0, 0]]}"), HasSubstr("is 24 mm long"));
}

TEST(CatalogJson, RefusesNumbersOutOfRange) {
  EXPECT_THAT(second_is(entry("-1", R"("m02")", R"("value": 3)", angle)), HasSubstr("id must be 0 or more"));
  EXPECT_THAT(second_is(entry("2147483648", R"("m02")", R"("value": 3)", angle)), HasSubstr("\"id\" is out of range"));
  EXPECT_THAT(second_is(entry("-99999999999", R"("m02")", R"("value": 3)", angle)),
              HasSubstr("\"id\" is out of range"));
  EXPECT_THAT(second_with(R"("value": 16)"), HasSubstr("does not fit in 6 cells"));
  for (const char* bad : {"0", "-4", "1e9"}) {
    EXPECT_THAT(second_shaped(R"({"kind": "angle", "cells": 6, "pitch": )" + std::string(bad) +
                              R"(, "radius": 3, "bend_radius": 0})"),
                HasSubstr("the pitch must be"));
  }
  EXPECT_THAT(second_shaped(R"({"kind": "line", "cells": 6, "pitch": 4, "radius": -3})"), HasSubstr("radius must be"));
  EXPECT_THAT(second_shaped(R"({"kind": "angle", "cells": 6, "pitch": 4, "radius": 3, "bend_radius": -1})"),
              HasSubstr("bend radius must be"));
  EXPECT_THAT(second_shaped(R"({"kind": "angle", "cells": 66, "pitch": 4, "radius": 3, "bend_radius": 1})"),
              HasSubstr("3 to 64 cells"));
}

TEST(CatalogJson, RefusesNamesThatCannotBeShown) {
  EXPECT_THAT(second_is(entry("2", R"("")", R"("value": 3)", angle)), HasSubstr("name is empty"));
  EXPECT_THAT(second_is(entry("2", R"("a\nb")", R"("value": 3)", angle)), HasSubstr("control character"));
  EXPECT_THAT(second_is(entry("2", '"' + std::string(48, 'x') + '"', R"("value": 3)", angle)), HasSubstr("47 bytes"));
}

TEST(CatalogJson, SaysWhereTextIsNoJson) {
  for (const std::string text :
       {"", "{", "{\"markers\": [}", "nan", "{\"markers\": [NaN]}", "{\"markers\": [1e999]}"}) {
    const std::string message = error_of([&] { catalog_from_json(text, "f.json"); });
    EXPECT_THAT(message, StartsWith("f.json: not valid JSON: "));
    EXPECT_EQ(message.find('\n'), std::string::npos);
    EXPECT_EQ(message.find("json.exception"), std::string::npos) << message;
  }
  EXPECT_THAT(error_of([] { catalog_from_json("{\n  \"markers\": [}", "f.json"); }), HasSubstr("line 2"));
}

}  // namespace
}  // namespace onestroke
