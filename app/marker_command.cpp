#include "app/marker_command.h"

#include "app/say.h"
#include "core/error.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iostream>

namespace onestroke {
namespace {

namespace fs = std::filesystem;

/// Beside the file first, then in its place, so that no half of it is ever there.
void write_text(const fs::path& file, const std::string& text) {
  fs::path draft = file;
  draft += ".part";
  std::error_code failed;
  {
    std::ofstream out(draft, std::ios::binary);
    out << text << std::flush;
    if (!out) failed = std::make_error_code(std::errc::io_error);
  }
  if (!failed) fs::rename(draft, file, failed);
  if (!failed) return;
  std::error_code ignored;
  fs::remove(draft, ignored);
  throw Error(file.string() +
              " cannot be written; check that its folder exists, that you may write there and that the disk "
              "is not full");
}

void import(const MarkerOptions& options, std::ostream& out) {
  const Catalog more = load_catalog(options.input);
  CatalogStore store(options.catalog, true);
  store.import(more, options.replace);
  out << more.markers.size() << (more.markers.size() == 1 ? " marker" : " markers") << " imported; "
      << options.catalog.string() << " holds " << store.load().markers.size() << "\n";
}

const MarkerSpec& find(const Catalog& catalog, const MarkerOptions& options) {
  const std::string& which = options.which;
  const auto named = std::ranges::find(catalog.markers, which, &MarkerSpec::name);
  if (named != catalog.markers.end()) return *named;
  int id = 0;
  const auto [end, error] = std::from_chars(which.data(), which.data() + which.size(), id);
  const MarkerSpec* found = error == std::errc{} && end == which.data() + which.size() ? catalog.find(id) : nullptr;
  if (found == nullptr)
    throw Error("there is no marker " + which + " in " + options.catalog.string() +
                "; `onestroke marker list` shows which there are");
  return *found;
}

}  // namespace

int marker_command(const MarkerOptions& options, std::ostream& out) {
  switch (options.action) {
    case MarkerOptions::Action::import:
      import(options, out);
      break;
    case MarkerOptions::Action::export_: {
      const std::string text = to_json(load_catalog(options.catalog));
      if (options.output.empty())
        out << text;
      else
        write_text(options.output, text);
      break;
    }
    case MarkerOptions::Action::list:
      out << describe(load_catalog(options.catalog));
      break;
    case MarkerOptions::Action::show: {
      const Catalog catalog = load_catalog(options.catalog);
      out << describe(find(catalog, options));
      break;
    }
  }
  end_output(out);
  return 0;
}

}  // namespace onestroke
