// A space of configurations as pieces are counted on it: covered by sheets, with the limits that it reaches.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "corank/analyze/aspects/aspects.h"
#include "corank/analyze/pieces/sign_cells.h"

namespace corank::analyze {

struct DividedSpace {
  System system;                       ///< as many equations fewer than variables as the space has dimensions
  std::shared_ptr<const Cover> cover;  ///< with its proof, where AspectsOptions::certificate asks for it
  std::vector<Polynomial> ends;        ///< the functions of the limits to which the cover comes
  std::vector<std::string> limits;     ///< names of those that the space reaches
  std::string reason;                  ///< why it is not known; empty where it is
};

DividedSpace divided_space(System system, const AspectsOptions& options, solve::Control& control);

/// Cells of the space on which the functions are known, as far as `options` and `control` let them be divided. The space has
/// to outlive them.
SignCells cells_of(const DividedSpace& space, const std::vector<Polynomial>& functions, const AspectsOptions& options,
                   solve::Control& control);

}  // namespace corank::analyze
