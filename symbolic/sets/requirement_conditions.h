// What a requirement's text asks of the feasible velocities of a mechanism, in expressions: before it is put into the
// variables of a system, or into the matrix of its limit (requirements.h).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "corank/symbolic/model/mechanism.h"

namespace corank::symbolic {

/// A condition on ker A, A's entries and all numbers as expressions in the model's units: that of VelocityTest.
struct VelocityCondition {
  std::vector<CoordinateKind> kinds;  ///< of the columns
  std::vector<std::vector<Expression>> rows;
  std::vector<Expression> form;
  struct Group {
    std::vector<int> columns;
    Expression weight;
  };
  std::vector<Group> groups;
  Expression bound;
  int ends = 1;
  bool of_tensions = false;
};

/// The same condition as a form on a line: of one load. Throws ModelError where there are several, and for tensions.
VelocityCondition as_form(const RequirementLine& line, VelocityCondition condition);

/// A condition on a distance of hulls: that of DistanceTest.
struct DistanceCondition {
  std::array<std::vector<std::array<Expression, 3>>, 2> hulls;
  Expression least;
};

/// A requirement: conditions on velocities, a function that is not to be positive, or distances.
struct Conditions {
  std::vector<VelocityCondition> of_velocities;
  std::optional<Expression> excess{};
  std::vector<DistanceCondition> of_distances{};
};

/// Throws ModelError for a distance: its limit is no zero of determinants, for what is nearest to what changes.
void refuse_distances(const RequirementLine& line, const Conditions& conditions);

/// Throws ModelError for cables' tensions.
void refuse_tensions(const RequirementLine& line, const VelocityCondition& condition);

/// One requirement after the other, of one mechanism, whose velocity equation is derived once.
class RequirementTranslator {
 public:
  /// `parameters`: constants that have no value, on which no limit may depend.
  RequirementTranslator(const Mechanism& mechanism, const std::vector<std::string>& parameters);
  ~RequirementTranslator();

  /// Throws ModelError as Requirements does.
  Conditions run(const RequirementLine& line);

 private:
  class Translator;
  std::unique_ptr<Translator> translator_;
};

}  // namespace corank::symbolic
