// The boxes of a cover as arrays, one row to a box, in the layout that NumPy shows: made once for a result, then looked at
// without copying.
#pragma once

#include <pybind11/numpy.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "corank/core/cover.h"

namespace corank::python {

namespace py = pybind11;

struct BoxArrays {
  BoxArrays(const std::vector<CoverBox>& boxes, std::size_t variables);

  std::size_t size = 0, variables = 0;
  std::vector<double> bounds;                              ///< size × variables × 2: lower and upper ends
  std::vector<std::uint8_t> free;                          ///< size × variables: 1 where the variable is free in the box
  std::vector<std::uint8_t> verdict, reason;               ///< indices of Verdict, Reason
  std::vector<std::uint8_t> types_proven, types_excluded;  ///< bits of SingularityType
  std::vector<std::uint8_t> passage;                       ///< indices of Passage
  std::vector<std::int32_t> kernel_at_most, region, point, part;  ///< as in CoverBox
};

/// A read-only array over memory that `owner` keeps alive.
template <class T>
py::array view(const std::shared_ptr<const BoxArrays>& owner, const std::vector<T>& data, std::vector<py::ssize_t> shape) {
  const py::capsule base(new std::shared_ptr<const BoxArrays>(owner),
                         [](void* p) { delete static_cast<std::shared_ptr<const BoxArrays>*>(p); });
  py::array_t<T> array(std::move(shape), data.data(), base);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

}  // namespace corank::python
