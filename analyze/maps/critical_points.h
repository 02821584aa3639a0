// Cusps and nodes of the curve on which solutions meet, over a plane of two lengths.
//
// Example: a positioning arm over its half plane (rho2, z). The image of its inverse singularities is the curve that bounds
// regions of different numbers of postures. At a cusp three postures meet, at a node two pairs meet at once. Classes of such
// arms are told apart by their numbers of cusps, nodes and aspects.
//
// The cusps and nodes are the isolated solutions of systems of their own (symbolic/sets/cusps_and_nodes.h), each proven.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/core/box.h"
#include "corank/solve/step/control.h"
#include "corank/study/question.h"

namespace corank::analyze {

struct CriticalPoint {
  Box sides;            ///< in the plane
  bool proven = false;  ///< it is there; else it may be
};

struct CriticalPoints {
  bool forward = false;  ///< of the forward locus, over the inputs; else of the inverse one, over the outputs
  std::vector<CriticalPoint> cusps{}, nodes{};
  /// There are no others in the region: proven. Nodes: whose two configurations are at least symbolic::kNodeDistance apart.
  bool cusps_known = false, nodes_known = false;
  std::string aspects{};  ///< "2 aspects, …", or bounds, of all configurations; empty: not found with few boxes
};

/// `names`, `region`: the plane. Throws symbolic::ModelError where its coordinates are not the mechanism's two outputs, or
/// its two inputs, both lengths, or where constants have tolerances. A search that takes too many boxes is given up: what it
/// would have found is not known.
CriticalPoints critical_points(const study::Question& question, const std::vector<std::string>& names, const Box& region,
                               int threads, solve::Control& control);

}  // namespace corank::analyze
