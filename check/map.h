// How many solutions has a system for every value of two of its variables, in cells of their plane, and of those behind
// them, which have their whole domains in each cell? All of these are the parameters; the latter are constants within
// tolerances, so that what is shown holds for every robot.
// Everything is found anew from the system; trusted is nothing but where to look.
//
//   at least   each sheet of a cell P is proven (check/sheets.h): for every p ∈ P exactly one zero x(p) in the region, at
//              which the Jacobian in x is regular, and it is in the exact domain. Two sheets differ for every p ∈ P where
//              they differ at one p₀ ∈ P: x is continuous (its graph is closed, its values lie in a compact region), so
//              {p : x(p) = x'(p)} is closed; it is open, since next to a regular zero there is one zero for each p
//              (implicit function theorem); P is connected.
//   complete   an exhaustive search of P × domain: each part of it has no solution, or lies in a sheet's region, or in a
//              box about it and the sheet's image in which the Jacobian is regular, so that there is at most one zero for
//              each p, the sheet's (check/krawczyk.h).
//   standing   a requirement is met by all sheets, or violated by one, over parts of the cell (check/requirement.h).
// The reduction keeps the parameters, so it is a bijection for each of their values (certify/reduction.h).
// What is shown holds for the values in the cell that are in the parameters' ranges.
#pragma once

#include <cstdint>
#include <vector>

#include "corank/check/checker.h"
#include "corank/core/map_claims.h"
#include "corank/core/requirement.h"

namespace corank::check {

struct MapCellReport {
  bool at_least = false;  ///< there are at least as many as claimed for every value
  bool complete = false;  ///< and no more
  bool standing = false;  ///< what is claimed of requirements holds for these solutions
};

struct MapReport : Findings {
  std::vector<MapCellReport> cells;
  std::size_t sheets = 0;   ///< that are confirmed
  std::uint64_t boxes = 0;  ///< of the searches for more solutions

  std::size_t at_least() const;  ///< cells
  std::size_t completed() const;
  /// Of each cell there are at least as many as claimed.
  bool verified() const;
  /// verified(), and nowhere are there more.
  bool complete() const;
};

/// `parameters`: two variables of the system, then those that have their whole domains. Never throws for what a claim says.
MapReport check_map(const System& system, const std::vector<int>& parameters, int copies,
                    const std::vector<Requirement>& requirements, const MapClaims& claims, const Options& options = {});

}  // namespace corank::check
