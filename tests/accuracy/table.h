#pragma once

#include "marker/catalog.h"
#include "score.h"

#include <iosfwd>

namespace onestroke::accuracy {

/// Finds the markers of every picture by itself, without memory.
Score measure(const Catalog& catalog, const std::function<void(const Visit&)>& pictures);

/// Markdown: a header, and one row a group.
void print_table_head(std::ostream& out);
void print_table_row(std::ostream& out, const std::string& group, const Score& score);

/// What was missed and what was reported wrongly, a line each.
void print_failures(std::ostream& out, const Score& score);

}  // namespace onestroke::accuracy
