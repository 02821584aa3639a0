// The exact points of a cover: are they solutions, and of which boxes?
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "corank/check/exact.h"
#include "corank/check/types.h"

namespace corank::check {

class ExactPoints {
 public:
  /// All have to outlive this. `types`: null where no labels can be confirmed.
  ExactPoints(const System& system, const Cover& cover, const TypeCheck* types, const StopFlag& stop)
      : system_(system), cover_(cover), types_(types), stop_(stop) {}

  /// Looks at the cover's next point: what could not be shown of it, or nothing.
  const std::string& check_next();
  /// Is this point confirmed, and are these labels, too?
  bool has_types(int point, const TypeLabels& labels) const {
    return faults_[point].empty() && types_ && types_->of_point(labels, *points_[point]).empty();
  }
  /// The box holds its exact point: a solution, or a configuration that explains it, with a kernel of dimension ≥ 2 (≥ c,
  /// where the system asks for c kernel vectors). Returns what could not be shown.
  std::string fault_in(const CoverBox& box, bool explained) const;
  /// Different exact points, or one outside the other's box.
  bool told_apart(const CoverBox& a, const CoverBox& b) const;

 private:
  const System& system_;
  const Cover& cover_;
  const TypeCheck* types_;
  const StopFlag& stop_;
  std::vector<std::unique_ptr<ExactCheck>> points_;
  std::vector<std::string> faults_;
};

}  // namespace corank::check
