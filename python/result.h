// A result as Python holds it: it never changes, and its arrays are made when somebody first asks for them. And what a page
// shows of a path, with the model as it was when the path was found.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "corank/report/html/path_page.h"
#include "corank/result/values/result.h"

namespace corank::python {

/// The boxes of a cover, one row to a box, in the layout that NumPy shows: looked at without copying.
struct BoxArrays {
  BoxArrays(const std::vector<CoverBox>& boxes, std::size_t variables);

  std::size_t size = 0, variables = 0;
  std::vector<double> bounds;      ///< size × variables × 2: lower and upper ends
  std::vector<std::uint8_t> free;  ///< size × variables: 1 where the variable is free
  /// Members of CoverBox by name: indices of Verdict, Reason, Passage and bits of SingularityType; numbers.
  std::vector<std::pair<const char*, std::vector<std::uint8_t>>> bytes;
  std::vector<std::pair<const char*, std::vector<std::int32_t>>> numbers;
};

class Result {
 public:
  explicit Result(result::Result value) : value_(std::make_shared<const result::Result>(std::move(value))) {}

  const result::Result& operator*() const { return *value_; }
  const result::Result* operator->() const { return value_.get(); }
  const std::shared_ptr<const result::Result>& shared() const { return value_; }
  std::shared_ptr<const BoxArrays> boxes() const { return arrays(value_->cover.boxes, boxes_); }
  std::shared_ptr<const BoxArrays> points() const { return arrays(value_->cover.points, points_); }
  /// For a picture, or for a page in as many boxes as it shows: cut where study::is_whole(), once; without the interpreter's
  /// lock. Copies share it, and it lives as long as they.
  const result::Result& drawn() const { return cut(*drawn_, 0); }
  const result::Result& on_page() const;

 private:
  std::shared_ptr<const BoxArrays> arrays(const std::vector<CoverBox>& boxes,
                                          std::shared_ptr<const BoxArrays>& known) const {
    if (!known) known = std::make_shared<const BoxArrays>(boxes, value_->variables.size());
    return known;
  }

  struct Cut {
    std::once_flag once;
    std::optional<result::Result> value;  // nothing: the result itself
  };
  const result::Result& cut(Cut& known, std::uint64_t most) const;

  std::shared_ptr<const result::Result> value_;
  std::shared_ptr<Cut> drawn_ = std::make_shared<Cut>(), on_page_ = std::make_shared<Cut>();
  // Under the interpreter's lock.
  mutable std::shared_ptr<const BoxArrays> boxes_, points_;
};

struct PathPicture {
  symbolic::Mechanism mechanism;
  report::PathView view;
};

}  // namespace corank::python
