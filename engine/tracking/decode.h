#pragma once

#include "marker/catalog.h"
#include "tracking/cells.h"
#include "tracking/chains.h"

#include <array>
#include <vector>

namespace onestroke {

/// One way to read part of a chain as part of a catalogued code: position p of the chain is cell first + direction * p,
/// for the links [begin, end) of the chain.
struct Reading {
  int chain = 0;
  int marker = 0;  ///< Index into the catalogue.
  int first = 0;
  int direction = 1;
  int begin = 0, end = 0;
  int agree = 0, contradict = 0;

  int cell_of(int position) const { return first + direction * position; }
  int score() const { return agree - 3 * contradict; }
};

/// Where each short run of cells occurs in a catalogue's codes, read in either direction: what makes reading quick
/// where cells are seen clearly.
class CodeWindows {
 public:
  explicit CodeWindows(const Catalog& catalog);

  /// The alignments of a chain (Reading with nothing but marker, first and direction) under which one of its runs of
  /// six cells agrees, two of them unseen at most; each once.
  void align(const std::vector<Cell>& cells, const Chain& chain, std::vector<Reading>& alignments);

 private:
  static constexpr int length = 6, max_unseen = 2;
  struct Place {
    int marker, first, direction;
  };
  void align_run(const std::array<int, length>& run, std::size_t done, std::size_t key, int begin,
                 std::vector<Reading>& alignments);
  void add(const Place& place, int begin, std::vector<Reading>& alignments);

  std::vector<std::vector<Place>> places_;  // By the run's inks as a number to the base of 3.
  // The chain, counted, to which each alignment was last added: by marker, direction and first cell.
  std::vector<std::uint32_t> added_;
  std::uint32_t chain_ = 0;
};

/// The readings of every chain, best first. A chain may be cut at both ends, may run past a tip or round a corner and
/// may miscount a gap, so each alignment of each code counts with its best stretch: the run of links that agree, where
/// one that contradicts costs three. A reading that another clearly outdoes on the same links is left out.
std::vector<Reading> read_chains(const Catalog& catalog, const std::vector<Cell>& cells,
                                 const std::vector<Chain>& chains);
/// The same of such alignments only as CodeWindows finds. Keeps its memory between pictures; used by one thread at a
/// time.
class QuickReader {
 public:
  /// The catalogue is borrowed.
  explicit QuickReader(const Catalog& catalog) : catalog_(catalog), windows_(catalog) {}

  void read(const std::vector<Cell>& cells, const std::vector<Chain>& chains, std::vector<Reading>& readings);

 private:
  const Catalog& catalog_;
  CodeWindows windows_;
  std::vector<Reading> alignments_, of_chain_;
};

}  // namespace onestroke
