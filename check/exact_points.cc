#include "corank/check/exact_points.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "corank/check/blow_up.h"

namespace corank::check {

const std::string& ExactPoints::check_next() {
  const ExactPoint& point = cover_.exact_points[faults_.size()];
  std::string reason;
  try {
    points_.emplace_back(std::make_unique<ExactCheck>(system_, point, stop_));
    reason = points_.back()->fault();
    if (reason.empty()) reason = points_.back()->holds();
    if (reason.empty()) reason = points_.back()->kernel();
    if (reason.empty() && point.types != TypeLabels{})
      reason =
          types_ ? types_->of_point(point.types, *points_.back()) : "it has types, but the file does not say of which ranks";
    if (reason.empty() && !(point.sole_within >= 0 && std::isfinite(point.sole_within))) reason = "a radius is not a number";
    if (reason.empty() && point.sole_within > 0) reason = check_sole(system_, *points_.back(), point.sole_within);
  } catch (const std::domain_error& error) {  // numbers of too many bits
    reason = error.what();
  } catch (const std::invalid_argument& error) {  // a face whose coefficients or powers are too large
    reason = error.what();
  }
  points_.resize(faults_.size() + 1);
  return faults_.emplace_back(std::move(reason));
}

std::string ExactPoints::fault_in(const CoverBox& box, bool explained) const {
  if (box.point < 0) return "the file has no exact point for it";
  const std::size_t p = box.point;
  if (!faults_[p].empty()) return "its exact point is not confirmed: " + faults_[p];
  for (int j = 0; j < system_.size(); ++j) {
    const Variable& v = system_.variables[j];
    if (!points_[p]->knows(j) && !(explained && v.kind == VariableKind::kernel))
      return "its exact point says nothing of " + v.name;
  }
  if (const int least = std::max(2, system_.kernel_vectors); explained && cover_.exact_points[p].corank < least)
    return "its exact point does not have a kernel of dimension " + std::to_string(least) + " or more";
  if (std::string reason = points_[p]->inside(box.box); !reason.empty()) return reason;
  return box.verdict == Verdict::exact ? points_[p]->within(cover_.exact_points[p].sole_within, box.box) : "";
}

bool ExactPoints::told_apart(const CoverBox& a, const CoverBox& b) const {
  for (const CoverBox* point : {&a, &b})
    if (point->verdict == Verdict::exact && (point->point < 0 || !faults_[point->point].empty())) return false;
  if (a.verdict != Verdict::exact) return b.verdict == Verdict::exact && told_apart(b, a);
  const ExactCheck& x = *points_[a.point];
  for (int j = 0; j < system_.size(); ++j) {
    if (!x.knows(j)) continue;
    if (b.verdict != Verdict::exact) {
      if (!x.coordinate(j).overlaps(b.box[j])) return true;
    } else if (const ExactCheck& y = *points_[b.point]; y.knows(j)) {
      if (!x.coordinate(j).overlaps(y.coordinate(j))) return true;
    }
  }
  return false;
}

}  // namespace corank::check
