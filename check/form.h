// The checker's own affine forms: c + Σ_j a_j δ_j for δ_j in sides, with some numbers c and a_j in enclosures.
#pragma once

#include "corank/check/rows.h"

namespace corank::check {

struct Form {
  Enclosure constant;
  Sides slopes;

  Enclosure range(const Sides& offsets) const;
  void add_multiple(const Enclosure& factor, const Form& f);
};

/// (c + Lδ)(d + Mδ) = cd + (cM + dL)δ + (Lδ)(Mδ).
Form product(const Form& f, const Form& g, const Sides& offsets);

}  // namespace corank::check
