// What a Newton step or a proof computes with. Inside certify/ only: elsewhere a step is a value (certify/newton.h).
#pragma once

#include <utility>

#include "corank/certify/newton.h"
#include "corank/certify/panel.h"

namespace corank::certify {

struct NewtonBuffers {
  Panel panel;  ///< Y and Y·S
  std::vector<Interval> slope, values, residual, offset, image, region, gradient;
  std::vector<double> center, magnitude, radius, next_radius;
  std::vector<unsigned char> is_dependent;
  std::vector<int> free;
  std::vector<Interval> stepped;  ///< the box of a step
  Preconditioner p;               ///< its rows and dependents, without Y
};

/// Buffers of a workspace for as long as this lives.
class BorrowedBuffers {
 public:
  explicit BorrowedBuffers(NewtonWorkspace& home) : home_(home), buffers_(home.take()) {}
  ~BorrowedBuffers() { home_.give_back(std::move(buffers_)); }
  BorrowedBuffers(const BorrowedBuffers&) = delete;
  BorrowedBuffers& operator=(const BorrowedBuffers&) = delete;
  NewtonBuffers& operator*() const { return *buffers_; }

 private:
  NewtonWorkspace& home_;
  std::unique_ptr<NewtonBuffers> buffers_;
};

}  // namespace corank::certify
