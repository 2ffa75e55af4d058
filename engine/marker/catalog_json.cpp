#include "core/error.h"
#include "marker/catalog.h"
#include "marker/catalog_rules.h"

#include <nlohmann/json.hpp>

#include <limits>
#include <set>
#include <string_view>

namespace onestroke {
namespace {

using Json = nlohmann::ordered_json;  // Notes keep their order.

/// The JSON library keeps the last of two equal keys; here the second is an error.
class DuplicateKeys {
 public:
  bool operator()(int, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) open_.emplace_back();
    if (event == Json::parse_event_t::object_end) open_.pop_back();
    if (event == Json::parse_event_t::key && !open_.back().insert(parsed.get<std::string>()).second)
      throw Error("key \"" + parsed.get<std::string>() + "\" is given twice in one object");
    return true;
  }

 private:
  std::vector<std::set<std::string>> open_;
};

Json parse(const std::string& text) {
  try {
    return Json::parse(text, DuplicateKeys{});
  } catch (const Json::exception& error) {
    // The library's message without its own error number, e.g. "at line 3, column 7: ...".
    std::string what = error.what();
    what.erase(0, std::min(what.size(), what.find("] ") + 2));
    throw Error("not valid JSON: " + what);
  }
}

/// One JSON object, every key of which must be asked for.
class Object {
 public:
  Object(const Json& value, const std::string& what) : value_(value) {
    if (!value.is_object()) throw Error(what + " must be an object, not " + value.type_name());
  }

  const Json* optional(const std::string& key) {
    known_.insert(key);
    const auto found = value_.find(key);
    return found == value_.end() ? nullptr : &*found;
  }
  const Json& required(const std::string& key) {
    const Json* found = optional(key);
    if (found == nullptr) throw Error("key \"" + key + "\" is missing");
    return *found;
  }
  void refuse_unknown() const {
    for (const auto& [key, value] : value_.items())
      if (!known_.contains(key)) throw Error("key \"" + key + "\" is unknown");
  }

  std::string text(const std::string& key) { return text(key, required(key)); }
  double number(const std::string& key) { return number(key, required(key)); }
  int integer(const std::string& key) {
    const Json& value = required(key);
    if (!value.is_number_integer()) throw Error("\"" + key + "\" must be a whole number");
    const bool fits = value.is_number_unsigned()
                          ? value.get<std::uint64_t>() <= std::uint64_t{std::numeric_limits<int>::max()}
                          : value.get<std::int64_t>() >= std::numeric_limits<int>::min();
    if (!fits) throw Error("\"" + key + "\" is out of range: " + value.dump());
    return value.get<int>();
  }

  static std::string text(const std::string& key, const Json& value) {
    if (!value.is_string()) throw Error("\"" + key + "\" must be a text, not " + value.type_name());
    return value.get<std::string>();
  }
  static double number(const std::string& key, const Json& value) {
    if (!value.is_number()) throw Error("\"" + key + "\" must be a number, not " + value.type_name());
    return value.get<double>();
  }

 private:
  const Json& value_;
  std::set<std::string> known_;
};

Vec3 vertex_from(const Json& value) {
  if (!value.is_array() || value.size() != 3) throw Error("each of \"vertices\" must be [x, y, z] in millimetres");
  const std::string what = "vertices";
  return {Object::number(what, value[0]), Object::number(what, value[1]), Object::number(what, value[2])};
}

Shape shape_from(const Json& value) {
  Object object(value, "\"shape\"");
  const std::string kind = object.text("kind");
  if (kind != "angle" && kind != "stroke" && kind != "line")
    throw Error("\"kind\" is \"" + kind + "\"; it must be \"angle\", \"stroke\" or \"line\"");
  const int cells = object.integer("cells");
  const double pitch = object.number("pitch"), radius = object.number("radius");
  const double bend = kind == "line" ? 0 : object.number("bend_radius");
  std::vector<Vec3> vertices;
  if (kind == "stroke") {
    const Json& list = object.required("vertices");
    if (!list.is_array()) throw Error("\"vertices\" must be a list of [x, y, z]");
    for (const Json& vertex : list) vertices.push_back(vertex_from(vertex));
  }
  object.refuse_unknown();
  if (kind == "stroke") return Shape::stroke(cells, pitch, radius, bend, std::move(vertices));
  return kind == "angle" ? Shape::angle(cells, pitch, radius, bend) : Shape::line(cells, pitch, radius);
}

Cells code_from(const Json* cells, const Json* value, int count) {
  if ((cells != nullptr) == (value != nullptr)) throw Error("give either \"cells\" or \"value\"");
  if (cells != nullptr) return cells_from_letters(Object::text("cells", *cells));
  if (!value->is_number_unsigned()) throw Error("\"value\" must be a whole number, 0 or more");
  return encode(value->get<std::uint64_t>(), count);
}

template <std::size_t N>
std::string one_of(const std::array<std::string_view, N>& words) {
  std::string text;
  for (std::size_t i = 0; i < N; ++i)
    text += (i == 0 ? "\"" : i + 1 < N ? ", \"" : " or \"") + std::string(words[i]) + "\"";
  return text;
}

template <class Value, std::size_t N>
Value word_from(const std::string& key, const Json& value, std::optional<Value> (*find)(std::string_view),
                const std::array<std::string_view, N>& words) {
  const std::string word = Object::text(key, value);
  const std::optional<Value> found = find(word);
  if (!found) throw Error("\"" + key + "\" is \"" + word + "\"; it must be " + one_of(words));
  return *found;
}

std::vector<ModelNote> notes_from(const Json& value) {
  if (!value.is_object()) throw Error("\"notes\" must be an object, not " + std::string(value.type_name()));
  std::vector<ModelNote> notes;
  for (const auto& [key, text] : value.items()) {
    if (!text.is_string()) throw Error("note \"" + key + "\" must be a text, not " + text.type_name());
    notes.emplace_back(key, text.get<std::string>());
  }
  return notes;
}

/// A file name, or an object that says more.
void read_model(const Json& value, MarkerSpec& marker) {
  if (!value.is_object()) {
    if (!value.is_string())
      throw Error("\"model\" must be a text, or an object with \"file\", not " + std::string(value.type_name()));
    marker.model = value.get<std::string>();
    return;
  }
  Object object(value, "\"model\"");
  marker.model = object.text("file");
  if (const Json* unit = object.optional("unit"))
    marker.import.unit = word_from<LengthUnit>("unit", *unit, length_unit_of, length_unit_words);
  if (const Json* up = object.optional("up"))
    marker.import.up = word_from<UpAxis>("up", *up, up_axis_of, up_axis_words);
  if (const Json* fit = object.optional("fit")) marker.import.fit = Object::number("fit", *fit);
  if (const Json* name = object.optional("name")) marker.model_name = Object::text("name", *name);
  if (const Json* version = object.optional("version")) marker.version = Object::text("version", *version);
  if (const Json* notes = object.optional("notes")) marker.notes = notes_from(*notes);
  object.refuse_unknown();
}

MarkerSpec marker_from(const Json& value) {
  Object object(value, "an entry of \"markers\"");
  const int id = object.integer("id");
  std::string name = object.text("name");
  Shape shape = shape_from(object.required("shape"));
  Cells cells = code_from(object.optional("cells"), object.optional("value"), shape.cells());
  const Json* model = object.optional("model");
  object.refuse_unknown();
  MarkerSpec marker{id, std::move(name), std::move(cells), std::move(shape), ""};
  if (model != nullptr) read_model(*model, marker);
  check_marker(marker);
  return marker;
}

/// An entry's name for messages, where it has one that can be read.
std::string name_in(const Json& entry) {
  if (!entry.is_object()) return {};
  const auto name = entry.find("name");
  return name != entry.end() && name->is_string() ? name->get<std::string>() : "";
}

Catalog catalog_from(const Json& document) {
  Object object(document, "the catalogue");
  const Json& entries = object.required("markers");
  object.refuse_unknown();
  if (!entries.is_array()) throw Error("\"markers\" must be a list");
  Catalog catalog;
  Uniqueness unique;
  for (const Json& entry : entries) {
    const std::string label = entry_label(static_cast<long long>(catalog.markers.size()) + 1, name_in(entry));
    try {
      catalog.markers.push_back(marker_from(entry));
      unique.add(catalog.markers.back(), label);
    } catch (const Error& error) {
      throw Error(label + ": " + error.what());
    }
  }
  sort_by_id(catalog);
  return catalog;
}

Json to_json_value(const Shape& shape) {
  constexpr std::string_view kinds[] = {"angle", "stroke", "line"};
  Json value{{"kind", kinds[static_cast<int>(shape.kind())]},
             {"cells", shape.cells()},
             {"pitch", shape.pitch()},
             {"radius", shape.radius()}};
  if (shape.kind() != Shape::Kind::line) value["bend_radius"] = shape.bend_radius();
  if (shape.kind() == Shape::Kind::stroke)
    for (const Vec3& v : shape.vertices()) value["vertices"].push_back({v.x, v.y, v.z});
  return value;
}

Json model_value(const MarkerSpec& marker) {
  Json value{{"file", marker.model}};
  if (marker.import.unit) value["unit"] = word_of(*marker.import.unit);
  if (marker.import.up) value["up"] = word_of(*marker.import.up);
  if (marker.import.fit) value["fit"] = *marker.import.fit;
  if (!marker.model_name.empty()) value["name"] = marker.model_name;
  if (!marker.version.empty()) value["version"] = marker.version;
  for (const auto& [key, text] : marker.notes) value["notes"][key] = text;
  if (value.size() == 1) return marker.model;
  return value;
}

}  // namespace

Catalog catalog_from_json(const std::string& text, const std::string& origin) {
  try {
    return catalog_from(parse(text));
  } catch (const Error& error) {
    throw Error(origin + ": " + error.what());
  }
}

std::string to_json(const Catalog& catalog) {
  std::string text = "{\"markers\": [";
  const char* separator = "\n";
  for (const MarkerSpec& marker : catalog.markers) {
    Json value{{"id", marker.id},
               {"name", marker.name},
               {"cells", to_letters(marker.cells)},
               {"shape", to_json_value(marker.shape)}};
    if (!marker.model.empty()) value["model"] = model_value(marker);
    text += separator + value.dump(-1, ' ', false, Json::error_handler_t::replace);
    separator = ",\n";
  }
  return text + "\n]}\n";
}

}  // namespace onestroke
