// A result as Python holds it: it never changes, and its arrays are made when somebody first asks for them.
#pragma once

#include <memory>

#include "corank/python/box_arrays.h"
#include "corank/result/result.h"

namespace corank::python {

class Result {
 public:
  explicit Result(result::Result value) : value_(std::make_shared<const result::Result>(std::move(value))) {}

  const result::Result& operator*() const { return *value_; }
  const result::Result* operator->() const { return value_.get(); }
  const std::shared_ptr<const result::Result>& shared() const { return value_; }
  std::shared_ptr<const BoxArrays> boxes() const { return arrays(value_->cover.boxes, boxes_); }
  std::shared_ptr<const BoxArrays> points() const { return arrays(value_->cover.points, points_); }

 private:
  std::shared_ptr<const BoxArrays> arrays(const std::vector<CoverBox>& boxes,
                                          std::shared_ptr<const BoxArrays>& known) const {
    if (!known) known = std::make_shared<const BoxArrays>(boxes, value_->variables.size());
    return known;
  }

  std::shared_ptr<const result::Result> value_;
  // Under the interpreter's lock.
  mutable std::shared_ptr<const BoxArrays> boxes_, points_;
};

}  // namespace corank::python
