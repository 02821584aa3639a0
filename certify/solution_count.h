// How many solutions a system has for every value of some of its variables, the parameters.
//
// F(p, x) = 0 has as many equations as x has components. A *sheet over* a box P of parameters is newton_prove's with the
// parameters as free variables: for every p ∈ P exactly one zero x(p) in its region's X-sides, which lies in the image's,
// inside their interior.
//
// Theorem (constant count; proof in doc/theory.md, "Maps over two parameters"):
//   (a) x(p) is continuous on P: the Jacobian in x is regular (implicit function theorem).
//   (b) Two sheets over P agree at one p ∈ P iff they agree at every p. {p : x(p) = x'(p)} is closed by (a), and open: near
//       such a p, x'(p) is in the interior of the first region's sides, where x(p) is the one zero; P is connected.
//   (c) Let every zero of F in P × D lie in the image of one of k sheets over P that differ pairwise, and let each of them
//       be in D, or outside, for all of P: then F(p, ·) has the same number of zeros in D for *every* p ∈ P, that of the
//       sheets in D. All of them are regular.
// So two boxes of parameters with a common point have the same number, where both have one.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "corank/certify/distinct.h"
#include "corank/certify/domain.h"
#include "corank/certify/newton.h"

namespace corank::certify {

/// Two sheets over the same box of parameters, with the same dependent variables and all rows: are they one? Disjoint
/// images, over P or over one p, say no; an image over one p inside the other's region says yes, by (b). All of these
/// require UpwardRounding::active().
Identity compare_over(const CompiledSystem& system, const Sheet& a, const Sheet& b, NewtonWorkspace& w);

/// The sheet over a part of its box of parameters, whose sides are those of the free variables in `box`; its image may be
/// tighter. The claim is about every value, so it holds for those.
Sheet restricted(const CompiledSystem& system, const Sheet& sheet, std::span<const Interval> box, NewtonWorkspace& w);

/// Does every zero in the box lie on the sheet? The box lies in the sheet's region, where each value of the parameters has
/// one.
bool lies_on(const Sheet& sheet, std::span<const Interval> box);

/// Removes sheets that are the same as an earlier one. False: of some two that is not known.
bool keep_distinct(const CompiledSystem& system, std::vector<Sheet>& sheets, NewtonWorkspace& w);

/// Which sheets are in the domain for every value of the parameters, where each of the others is outside for every value.
/// Nothing: one may cross an end of the domain. The parameters' own ends are none.
std::optional<std::vector<std::size_t>> sheets_inside(const CompiledSystem& system, const DomainTest& domain,
                                                      const std::vector<Sheet>& sheets, NewtonWorkspace& w);

}  // namespace corank::certify
