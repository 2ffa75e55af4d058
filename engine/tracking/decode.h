#pragma once

#include "marker/catalog.h"
#include "tracking/cells.h"
#include "tracking/chains.h"

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

/// The readings of every chain, best first. A chain may be cut at both ends, may run past a tip or round a corner and
/// may miscount a gap, so each alignment of each code counts with its best stretch: the run of links that agree, where
/// one that contradicts costs three. A reading that another clearly outdoes on the same links is left out.
std::vector<Reading> read_chains(const Catalog& catalog, const std::vector<Cell>& cells,
                                 const std::vector<Chain>& chains);

}  // namespace onestroke
