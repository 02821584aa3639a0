// The shape of a C-space, or of the solutions of a plain system: pieces, Euler characteristic, genus; each number proven.
//
// Theorem (Morse; Milnor, "Morse Theory", 1963, §§ 3, 5): let M be a compact smooth manifold without boundary and h a
// smooth function all of whose critical points are nondegenerate. Then χ(M) = Σ (−1)^index over them, and every component
// holds a minimum.
//   M is smooth: every point of it lies in a `regular` box, where the Jacobian of the equations has full rank.
//   M is compact and has no boundary in the search domain: no box has contact with an end of it (limits.h).
//   The critical points are all there, and distinct: the points of a complete cover, each `isolated` or `exact`; with two
//   kernel vectors ±ξ told apart by its half-space, where the points' a·ξ is not 0.
//   Each is nondegenerate, with that index: certify/inertia.h on the kernel of Φ_q.
// A closed manifold of odd dimension has χ = 0 (Poincaré duality). M is the regular level set of Φ in a product of circles
// and lines, so it is orientable, and a closed surface of genus 1 − χ/2 where its dimension is 2 and it is connected.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "corank/analyze/robots/robots.h"
#include "corank/analyze/sets/components.h"
#include "corank/core/shape.h"
#include "corank/study/question.h"

namespace corank::result {
struct ShapeFile;
}

namespace corank::analyze {

/// What one height says.
struct HeightCount {
  std::vector<int> by_index;  ///< number of critical points of index 0, 1 … dimension
  int uncounted = 0;          ///< critical points on the ends across which the height does not grow inward
  std::vector<int>
      euler_of_piece;   ///< Σ (−1)^index over the points on each piece; empty where some point is on no known one
  std::string problem;  ///< why nothing follows; empty where something does
  /// The points, where a certificate is asked for.
  std::optional<HeightCover> cover;

  int points() const;
  int euler_characteristic() const;
};

struct Topology {
  int dimension = 0;
  bool smooth = false;  ///< proven: a manifold without boundary in the search domain
  /// Limits and other ends of the search domain to which the set comes: its components are those strictly within them.
  std::vector<std::string> ends;
  bool with_ends = false;  ///< proven: a manifold with boundary and corners (certify/stratum.h)
  Components components;
  std::optional<int> boundary;  ///< of a surface with ends: the closed curves that bound it
  std::optional<int> euler_characteristic;
  /// Of each component, ascending; of surfaces only, where the components' number is exact.
  std::vector<int> genus;
  std::vector<HeightCount> heights;  ///< two that agree, where the characteristic is known
  std::string reason;                ///< what is not known, and why; empty where all is
  std::uint64_t processed = 0;       ///< boxes of all searches
  /// Where it was asked for and can be given: for others to check. Nothing of sets that come to an end, and of points.
  std::shared_ptr<const Shape> certificate;
  /// Where constants have tolerances: are the numbers those of every robot? All else is of the one that was drawn.
  std::optional<Robots> robots;
  std::string stopped;  ///< what ended the analysis early; empty: nothing
};

struct TopologyOptions {
  int threads = 1;
  int halvings = 16, rounds = 16;               ///< SignCells::refine, where the set has ends
  int refinements = 5;                          ///< σ is halved so often while links or gaps are missing
  std::uint64_t most_for_a_height = 2'000'000;  ///< boxes processed in a search for critical points
  bool certificate = false;                     ///< keep what it takes to check the result
};

/// Of the configurations (Question::set is ignored) of a mechanism, or of the solutions of a plain system. Where the
/// control ends it early, what is proven so far. Throws symbolic::ModelError as study::system does, and where a certificate
/// is asked for of constants with tolerances.
Topology topology(study::Question question, const TopologyOptions& options, solve::Control& control);

/// Of the configurations of one robot; `system`: study::system(question), of the set cspace.
Topology topology_of_one(const study::Question& question, const System& system, const TopologyOptions& options,
                         solve::Control& control);

/// What is written of it, for others to check. Requires its certificate.
result::ShapeFile to_file(const study::Question& question, const Topology& topology);

/// A few lines for a terminal.
std::string to_text(const study::Question& question, const Topology& topology);
/// {"components": {"at_least", "at_most"}, "euler_characteristic", "genus", "critical_points" …}; doc/topology.md.
std::string to_json(const study::Question& question, const Topology& topology);

}  // namespace corank::analyze
