#include "scene/ply_layout.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <optional>
#include <sstream>
#include <string_view>

namespace onestroke {

namespace {

enum class Form { ascii, little, big };

struct Property {
  std::string name;
  std::size_t size = 0;        // Of a number, bytes.
  std::size_t count_size = 0;  // Of a list's length; 0 for a single number.
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  bool has(std::string_view property) const {
    return std::any_of(properties.begin(), properties.end(), [&](const Property& p) { return p.name == property; });
  }
};

std::optional<std::size_t> size_of(std::string_view type) {
  struct Named {
    std::string_view name;
    std::size_t size;
  };
  constexpr std::array types{Named{"char", 1},  Named{"int8", 1},    Named{"uchar", 1},  Named{"uint8", 1},
                             Named{"short", 2}, Named{"int16", 2},   Named{"ushort", 2}, Named{"uint16", 2},
                             Named{"int", 4},   Named{"int32", 4},   Named{"uint", 4},   Named{"uint32", 4},
                             Named{"float", 4}, Named{"float32", 4}, Named{"double", 8}, Named{"float64", 8}};
  const auto found = std::find_if(types.begin(), types.end(), [&](const Named& t) { return t.name == type; });
  return found == types.end() ? std::nullopt : std::optional(found->size);
}

class Layout {
 public:
  Layout(std::string file, const Bytes& bytes)
      : file_(std::move(file)), text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()) {}

  void check() {
    read_header();
    body_ = at_;
    check_elements();
    for (const Element& element : elements_) form_ == Form::ascii ? walk_lines(element) : walk_bytes(element);
  }

  // Where the numbers begin.
  std::size_t body() const { return body_; }
  // Behind the end of a line Assimp takes another for the second half of it, unless it was of two halves already.
  bool looks_like_line_end() const {
    return form_ != Form::ascii && text_.substr(body_, 1) == "\n" && text_[body_ - 2] != '\r';
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(file_ + ": " + what + "; export the model again");
  }
  [[noreturn]] void fail_short() const { fail("not a whole PLY file, it is cut short"); }

  // Without its end; at_ is then behind it.
  std::string_view line() {
    const std::size_t end = text_.find('\n', at_);
    if (end == std::string_view::npos && at_ >= text_.size()) fail_short();
    std::string_view found = text_.substr(at_, end == std::string_view::npos ? end : end - at_);
    at_ = end == std::string_view::npos ? text_.size() : end + 1;
    if (!found.empty() && found.back() == '\r') found.remove_suffix(1);
    return found;
  }

  void read_header() {
    if (line() != "ply") fail("not a PLY file");
    for (std::string_view l = line(); l != "end_header"; l = line()) {
      std::istringstream words{std::string(l)};
      std::string first, type;
      words >> first >> type;
      if (first == "format")
        read_form(type);
      else if (first == "element")
        read_element(type, words);
      else if (first == "property")
        read_property(type, words);
      // Anything else is a comment, as some exporters write them.
    }
    if (!form_) fail("its header does not say which format it has");
  }

  static std::string printable(std::string word) {
    word.resize(std::min<std::size_t>(word.size(), 40));
    std::replace_if(
        word.begin(), word.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return word;
  }

  void read_form(const std::string& word) {
    if (word == "ascii") form_ = Form::ascii;
    if (word == "binary_little_endian") form_ = Form::little;
    if (word == "binary_big_endian") form_ = Form::big;
    if (!form_) fail("its format is \"" + printable(word) + "\"");
  }

  void read_element(const std::string& name, std::istringstream& words) {
    Element element;
    element.name = name;
    std::string count;
    words >> count;
    const char* end = count.data() + count.size();
    const auto [stop, error] = std::from_chars(count.data(), end, element.count);
    if (count.empty() || error != std::errc{} || stop != end || element.count > text_.size())
      fail("it says it has \"" + printable(count) + "\" of \"" + printable(name) + "\", which it does not");
    elements_.push_back(element);
  }

  void read_property(const std::string& type, std::istringstream& words) {
    if (elements_.empty()) fail("its header is damaged");
    Property property;
    std::string number = type, count;
    if (type == "list") words >> count >> number;
    words >> property.name;
    const auto size = size_of(number), count_size = size_of(type == "list" ? count : "char");
    if (!size || !count_size || property.name.empty() || count.starts_with('f') || count.starts_with('d'))
      fail("its header says \"" + printable(type + " " + number) + "\"");
    property.size = *size;
    property.count_size = type == "list" ? *count_size : 0;
    elements_.back().properties.push_back(property);
  }

  void check_elements() const {
    const auto find = [&](std::string_view name) {
      return std::find_if(elements_.begin(), elements_.end(), [&](const Element& e) { return e.name == name; });
    };
    const auto vertex = find("vertex"), face = find("face"), strips = find("tristrips");
    if (vertex == elements_.end() || !vertex->has("x") || !vertex->has("y") || !vertex->has("z"))
      fail("its vertices have no x, y and z");
    if ((face == elements_.end() || face->count == 0) && (strips == elements_.end() || strips->count == 0))
      throw Error(file_ + ": it is a cloud of points, without faces; make a surface of it, as MeshLab does");
    if (face != elements_.end() && !face->has("vertex_indices") && !face->has("vertex_index"))
      fail("its faces name no vertices");
  }

  void walk_lines(const Element& element) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      std::string_view rest = line();
      for (const Property& p : element.properties) {
        const double first = number(rest);
        if (p.count_size == 0) continue;
        if (!(first >= 0 && first <= static_cast<double>(text_.size()))) fail("the length of a list is damaged");
        for (auto n = static_cast<std::uint64_t>(first); n > 0; --n) number(rest);
      }
    }
  }

  // Takes the next one off the line.
  double number(std::string_view& rest) const {
    constexpr const char* between = " \t";
    const std::size_t start = std::min(rest.find_first_not_of(between), rest.size());
    const std::size_t end = std::min(rest.find_first_of(between, start), rest.size());
    std::string_view word = rest.substr(start, end - start);
    rest.remove_prefix(end);
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc::invalid_argument || stop != word.data() + word.size())
      fail(word.empty() ? "a line has too few numbers, or is missing"
                        : "it says \"" + printable(std::string(word)) + "\" where a number should be");
    return value;
  }

  void walk_bytes(const Element& element) {
    for (std::uint64_t i = 0; i < element.count; ++i)
      for (const Property& p : element.properties) {
        const std::uint64_t n = p.count_size == 0 ? 1 : take_count(p.count_size);
        if (n > (text_.size() - at_) / p.size) fail_short();
        at_ += n * p.size;
      }
  }

  std::uint64_t take_count(std::size_t size) {
    if (text_.size() - at_ < size) fail_short();
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const auto byte = static_cast<unsigned char>(text_[at_ + (form_ == Form::big ? i : size - 1 - i)]);
      value = value << 8U | byte;
    }
    at_ += size;
    return value;
  }

  const std::string file_;
  const std::string_view text_;
  std::size_t at_ = 0, body_ = 0;
  std::optional<Form> form_;
  std::vector<Element> elements_;
};

}  // namespace

void prepare_ply(const std::string& file, Bytes& bytes) {
  Layout layout(file, bytes);
  layout.check();
  if (layout.looks_like_line_end()) bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(layout.body()), '\n');
}

}  // namespace onestroke
