#include "tracking/decode.h"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>

namespace onestroke {
namespace {

constexpr int min_score = 4;
// First cells that are told apart where alignments are: more than a chain and a code are long together.
constexpr std::size_t firsts = 512;

// The best stretch of one alignment (Kadane's algorithm).
Reading best_stretch(const Cells& code, const std::vector<Cell>& cells, const Chain& chain, const Reading& alignment) {
  Reading best = alignment;
  const int n = static_cast<int>(code.size()), links = static_cast<int>(chain.links.size());
  int begin = 0, agree = 0, contradict = 0, score = 0, best_score = 0;
  for (int i = 0; i < links; ++i) {
    const Chain::Link& l = chain.links[static_cast<std::size_t>(i)];
    const int cell = alignment.cell_of(l.position);
    const bool agrees =
        cell >= 0 && cell < n &&
        cells[static_cast<std::size_t>(l.cell)].ink == static_cast<std::uint8_t>(code[static_cast<std::size_t>(cell)]);
    if (score <= 0) {
      if (!agrees) continue;
      begin = i;
      agree = contradict = score = 0;
    }
    ++(agrees ? agree : contradict);
    score += agrees ? 1 : -3;
    if (score <= best_score) continue;
    best_score = score;
    best.begin = begin;
    best.end = i + 1;
    best.agree = agree;
    best.contradict = contradict;
  }
  return best;
}

// A joined row is read for what its pieces say together; each alone is a row of its own.
bool spans_joints(const Reading& r, const Chain& chain) {
  return chain.joints.empty() || (r.begin < chain.joints.front() && r.end > chain.joints.back());
}

// A reading that another one of the same chain explains better by this much is chance: codes agree by half with
// anything.
constexpr int clear_margin = 4;

bool outdone(const Reading& r, std::span<const Reading> better) {
  return std::any_of(better.begin(), better.end(), [&](const Reading& q) {
    const int shared = std::min(q.end, r.end) - std::max(q.begin, r.begin);
    return q.chain == r.chain && q.score() >= r.score() + clear_margin && 10 * shared >= 7 * (r.end - r.begin);
  });
}

std::vector<Reading> best_of(std::vector<Reading> readings) {
  std::stable_sort(readings.begin(), readings.end(),
                   [](const Reading& a, const Reading& b) { return a.score() > b.score(); });
  std::vector<Reading> kept;
  for (const Reading& r : readings)
    if (!outdone(r, kept)) kept.push_back(r);
  return kept;
}

}  // namespace

CodeWindows::CodeWindows(const Catalog& catalog) {
  std::size_t keys = 1;
  for (int i = 0; i < length; ++i) keys *= 3;
  places_.resize(keys);
  added_.resize(catalog.markers.size() * 2 * firsts);
  for (std::size_t m = 0; m < catalog.markers.size(); ++m) {
    const Cells& code = catalog.markers[m].cells;
    const int n = static_cast<int>(code.size());
    for (const int direction : {1, -1})
      for (int first = direction > 0 ? 0 : n - 1; direction > 0 ? first + length <= n : first - length >= -1;
           first += direction) {
        std::size_t key = 0;
        for (int i = 0; i < length; ++i)
          key = 3 * key + static_cast<std::size_t>(code[static_cast<std::size_t>(first + direction * i)]);
        places_[key].push_back({static_cast<int>(m), first, direction});
      }
  }
}

void CodeWindows::align(const std::vector<Cell>& cells, const Chain& chain, std::vector<Reading>& alignments) {
  alignments.clear();
  ++chain_;
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    const int begin = chain.links[i].position;
    if (begin + length > chain.length()) return;
    // By inks; -1 for a cell that is not seen.
    std::array<int, length> run;
    run.fill(-1);
    for (std::size_t k = i; k < chain.links.size() && chain.links[k].position < begin + length; ++k)
      run[static_cast<std::size_t>(chain.links[k].position - begin)] =
          cells[static_cast<std::size_t>(chain.links[k].cell)].ink;
    if (std::count(run.begin(), run.end(), -1) <= max_unseen) align_run(run, 0, 0, begin, alignments);
  }
}

// Tries every ink for cells that are not seen.
void CodeWindows::align_run(const std::array<int, length>& run, std::size_t done, std::size_t key, int begin,
                            std::vector<Reading>& alignments) {
  if (done == run.size()) {
    for (const Place& p : places_[key]) add(p, begin, alignments);
    return;
  }
  for (int ink = 0; ink < 3; ++ink)
    if (run[done] < 0 || run[done] == ink)
      align_run(run, done + 1, 3 * key + static_cast<std::size_t>(ink), begin, alignments);
}

void CodeWindows::add(const Place& p, int begin, std::vector<Reading>& alignments) {
  Reading r;
  r.marker = p.marker;
  r.direction = p.direction;
  r.first = p.first - p.direction * begin;
  const auto way = static_cast<std::size_t>(2 * p.marker + (p.direction > 0 ? 1 : 0));
  std::uint32_t& last = added_[way * firsts + static_cast<std::size_t>(r.first + static_cast<int>(firsts)) % firsts];
  if (last == chain_) return;
  last = chain_;
  alignments.push_back(r);
}

void QuickReader::read(const std::vector<Cell>& cells, const std::vector<Chain>& chains,
                       std::vector<Reading>& readings) {
  readings.clear();
  const auto by_score = [](const Reading& a, const Reading& b) {
    return std::tuple(-a.score(), a.chain, a.marker, a.direction, a.first) <
           std::tuple(-b.score(), b.chain, b.marker, b.direction, b.first);
  };
  for (std::size_t c = 0; c < chains.size(); ++c) {
    windows_.align(cells, chains[c], alignments_);
    of_chain_.clear();
    for (Reading& a : alignments_) {
      a.chain = static_cast<int>(c);
      const Reading r = best_stretch(catalog_.markers[static_cast<std::size_t>(a.marker)].cells, cells, chains[c], a);
      if (r.score() >= min_score) of_chain_.push_back(r);
    }
    std::sort(of_chain_.begin(), of_chain_.end(), by_score);
    const auto first = static_cast<std::ptrdiff_t>(readings.size());
    for (const Reading& r : of_chain_)
      if (!outdone(r, {readings.begin() + first, readings.end()})) readings.push_back(r);
  }
  std::sort(readings.begin(), readings.end(), by_score);
}

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
          if (r.score() >= min_score && spans_joints(r, chains[c])) readings.push_back(r);
        }
    }
  }
  return best_of(std::move(readings));
}

}  // namespace onestroke
