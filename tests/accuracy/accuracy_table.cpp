// accuracy_table [--failures]: how well the tracker does, as a Markdown table.

#include "core/error.h"
#include "photoreal_set.h"
#include "synthetic_set.h"
#include "table.h"

#include <iostream>
#include <string_view>

int main(int argc, char** argv) try {
  using namespace onestroke::accuracy;
  const bool failures = argc > 1 && std::string_view(argv[1]) == "--failures";
  const auto row = [&](const std::string& name, const onestroke::Catalog& catalog, const auto& pictures) {
    const Score score = measure(catalog, pictures);
    print_table_row(std::cout, name, score);
    if (failures) print_failures(std::cerr, score);
  };
  print_table_head(std::cout);
  const onestroke::Catalog catalog = synthetic_catalog();
  for (const std::string& group : synthetic_groups())
    row("synthetic, " + group, catalog, [&](const Visit& visit) { draw_synthetic(group, visit); });
  if (photoreal_folder().empty()) {
    std::cerr << photoreal_missing << '\n';
    return 0;
  }
  const PhotorealSet set(photoreal_folder());
  for (const char* group : {"booth", "sphere", "hands", "turntable", "hmd", "multi"})
    row(std::string("photoreal, ") + group, set.catalog(), [&](const Visit& visit) { set.visit(group, visit); });
  return 0;
} catch (const onestroke::Error& e) {
  std::cerr << e.what() << '\n';
  return 1;
}
