// In which units a kernel vector counts, so that neither the model's unit of length nor generous ranges steer a search.
//
// A velocity mixes lengths and angles: ẋ in mm/s is a thousand times ẋ in m/s, the angular rate beside it stays. In the
// kernel equations column j of the matrix M is therefore multiplied by a fixed positive number s_j, M diag(s) ξ = 0 with ‖ξ‖
// = 1, so that s_j ξ_j is the rate itself. M diag(s) has the rank of M: the configurations are the same for every s.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {

/// s of each kernel unknown, as texts of rational numbers; none where all are 1. A length's is its typical size: half its
/// range, as the constraints leave it, is rounded to a power of two times the largest; beside angles, whose scale is 1, four
/// times the largest is rounded to two digits (so that a model in other units has the same system but for this number).
/// Where the kernel holds no angle, the largest is 1. Of the left kernel, whose unknowns belong to equations: 1/max_j
/// |∂Φ_i/∂q_j| s_j over those ranges, relative to the smallest and rounded to powers of two. Of a rate that was eliminated
/// from the kernel (KernelQuestion::passive) a power of two by which it stays within [−1/2, 1/2] wherever the others are in
/// [−1, 1] and the coordinates in their ranges, so that its own range is no condition.
///
/// Where the mechanism brings its own L, an angular rate's scale is 1, too, and a linear one's size comes from L over those
/// ranges, a lever arm; it is rounded as those of lengths above, eight times the largest in place of four. Of a left kernel:
/// 1/max_j |L_ij| s_j relative to the first row, in two digits.
///
/// Of cusps and nodes: those of the locus by coordinates, without elimination, and one number more, by which the scale of a
/// length is its typical size: it takes the unit out of second derivatives and distances (cusps_and_nodes.h).
std::vector<std::string> kernel_scales(const Mechanism& mechanism, SingularitySet set,
                                       std::optional<KernelSide> side = std::nullopt);
std::vector<std::string> kernel_scales(const Mechanism& mechanism, const KernelQuestion& kernel);

/// Of each of the mechanism's equations max_j |∂Φ_i/∂q_j| s_j over those ranges, s_j half the range of a variable; 1 where
/// that is 0 or unbounded.
std::vector<double> equation_sizes(const Mechanism& mechanism);

/// Of each coordinate half its range, as the constraints leave it, in two digits, as the text of a rational number; "1" of
/// angles and directions.
std::vector<std::string> coordinate_sizes(const Mechanism& mechanism);

}  // namespace corank::symbolic
