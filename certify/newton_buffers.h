// What a Newton step or a proof computes with. Inside certify/ only: elsewhere a step is a value (certify/newton.h).
#pragma once

#include "corank/certify/newton.h"
#include "corank/certify/panel.h"

namespace corank::certify {

struct NewtonBuffers {
  Panel panel;  ///< Y and Y·S
  std::vector<Interval> slope, values, residual, offset, image, region, gradient;
  std::vector<double> center;
  std::vector<unsigned char> is_dependent;
  std::vector<int> free;
  std::vector<Interval> stepped;  ///< the box of a step
  Preconditioner p;               ///< its rows and dependents, without Y
};

}  // namespace corank::certify
