#include "tracking/decode.h"

#include <algorithm>

namespace onestroke {
namespace {

constexpr int min_score = 4;

// The best stretch of one alignment (Kadane's algorithm).
Reading best_stretch(const Cells& code, const std::vector<Cell>& cells, const Chain& chain, const Reading& alignment) {
  Reading best = alignment, run = alignment;
  const int n = static_cast<int>(code.size());
  for (int i = 0; i < static_cast<int>(chain.links.size()); ++i) {
    const Chain::Link& l = chain.links[static_cast<std::size_t>(i)];
    const int cell = alignment.cell_of(l.position);
    const bool agrees =
        cell >= 0 && cell < n &&
        cells[static_cast<std::size_t>(l.cell)].ink == static_cast<std::uint8_t>(code[static_cast<std::size_t>(cell)]);
    if (run.score() <= 0 || run.end == run.begin) {
      run = alignment;
      run.begin = run.end = i;
      if (!agrees) continue;
    }
    ++(agrees ? run.agree : run.contradict);
    run.end = i + 1;
    if (agrees && run.score() > best.score()) best = run;
  }
  return best;
}

// A reading that another one of the same chain explains better by this much is chance: codes agree by half with
// anything.
constexpr int clear_margin = 4;

bool outdone(const Reading& r, const std::vector<Reading>& better) {
  return std::any_of(better.begin(), better.end(), [&](const Reading& q) {
    const int shared = std::min(q.end, r.end) - std::max(q.begin, r.begin);
    return q.chain == r.chain && q.score() >= r.score() + clear_margin && 10 * shared >= 7 * (r.end - r.begin);
  });
}

}  // namespace

std::vector<Reading> read_chains(const Catalog& catalog, const std::vector<Cell>& cells,
                                 const std::vector<Chain>& chains) {
  std::vector<Reading> readings;
  for (std::size_t c = 0; c < chains.size(); ++c) {
    const int length = chains[c].length();
    for (std::size_t m = 0; m < catalog.markers.size(); ++m) {
      const Cells& code = catalog.markers[m].cells;
      const int n = static_cast<int>(code.size());
      for (int offset = min_score - length; offset <= n - min_score; ++offset)
        for (const int direction : {1, -1}) {
          Reading r;
          r.chain = static_cast<int>(c);
          r.marker = static_cast<int>(m);
          r.direction = direction;
          r.first = direction > 0 ? offset : offset + length - 1;
          r = best_stretch(code, cells, chains[c], r);
          if (r.score() >= min_score) readings.push_back(r);
        }
    }
  }
  std::stable_sort(readings.begin(), readings.end(),
                   [](const Reading& a, const Reading& b) { return a.score() > b.score(); });
  std::vector<Reading> kept;
  for (const Reading& r : readings)
    if (!outdone(r, kept)) kept.push_back(r);
  return kept;
}

}  // namespace onestroke
