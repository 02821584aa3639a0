// Columns of an arm's matrix in joints that depend on each other: what they say of where it loses the rank of its rows.
#pragma once

#include <optional>
#include <vector>

#include "corank/symbolic/sets/joint_zeros.h"

namespace corank::symbolic {

/// Of three rows, where a vector w ≠ 0 in the joints is in the left kernel of some columns B: functions that are all 0
/// exactly where the rank is lost. The axes of B meet in a point, and w leads from there to the tip.
///
/// Theorem: let all minors of three columns of B vanish, v_A = a × b for each pair A = {a, b} of B, and let the minor of A
/// and any other column k, v_A · k, vanish exactly where f_A or c_k does. If nowhere all v_A are 0, and nowhere all f_A, the
/// rank is lost exactly where all c_k are 0. For there all v_A · k are 0, some v_A is not, so its A has rank two and all
/// columns are combinations of A. And where the rank is lost, all v_A · k are 0, some f_A is not, so all c_k are 0.
std::optional<std::vector<RationalPolynomial>> rank_conditions(const ExactMatrix& matrix, JointZeros& zeros);

/// A matrix of which, with a joint q at these values, two columns are the same but for their signs.
struct AgreeingColumns {
  std::vector<QuarterTurns> values;
  ExpressionMatrix elsewhere;
};

/// Theorem: let columns x and y be the same but for signs where p, the sine or the cosine of q, is 0. Then y minus a
/// multiple of x is p times a column z, and the matrix with z in place of y, `elsewhere`, loses rank where p ≠ 0 and the
/// matrix does. Where p = 0 it does so only where the matrix does, too, whose columns are combinations of its. So the rank
/// is lost where `elsewhere` loses it, and at those values where the matrix does. Pairs of `elsewhere`'s columns are turned
/// by joints' angles.
std::optional<AgreeingColumns> agreeing_columns(const Mechanism& mechanism, const ExactMatrix& matrix,
                                                const JointZeros& zeros, const Ended& ended);

/// With a joint at a value: without columns that are 0, or another one but for signs.
ExpressionMatrix matrix_at(const ExactMatrix& matrix, const JointZeros& zeros, const QuarterTurns& value);

}  // namespace corank::symbolic
