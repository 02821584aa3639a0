// What aspects are counted on, made once: the equations of C-space and the functions that divide it, as polynomials. All
// that is asked of the model is in it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "corank/analyze/sets/standing.h"
#include "corank/study/question.h"

namespace corank::analyze {

/// Of what divides a set into aspects, assembly modes and working modes. Polynomial::source is a function's text.
template <class T>
using Lists = std::array<std::vector<T>, 3>;

/// A factor of a C-space that is a product (symbolic::IndependentPart).
struct PartEquations {
  std::vector<std::string> coordinates;
  System system;
  Lists<Polynomial> functions;
  Lists<std::size_t> places;  ///< of the functions in C-space's lists
};

/// C-space as the graph of a map over free coordinates (symbolic/sets/free_coordinates.h).
struct ProductEquations {
  std::vector<PartEquations> parts;
  std::vector<int> given;          ///< the variables of C-space that the map gives, in the order of their equations
  std::vector<Polynomial> values;  ///< of them
  bool counts = true;              ///< more than two coordinates are free that have no single value
};

/// The cusps of a locus, and its factors' symbolic::cusp_sides.
struct CuspEquations {
  study::Question question;
  System system{};
  std::vector<Polynomial> sides{};
  std::vector<std::size_t> places;  ///< of the factors among all functions
  std::string reason{};             ///< why the cusps cannot be asked for; empty where they can
};

struct AspectEquations {
  study::Question question;  ///< about C-space
  System system{};
  Lists<Polynomial> functions{};                        ///< the first list holds all
  std::array<std::vector<std::string>, 2> factors{};    ///< of det L_y, det L_z
  std::vector<Polynomial> constants{};                  ///< factors of both without a coordinate
  std::array<std::vector<Polynomial>, 2> matrices{};    ///< L_y, L_z, row by row
  std::vector<std::string> required{}, further{};       ///< of pieces; and functions that divide C-space for it
  std::optional<Standings> standings{};                 ///< where something is required
  std::optional<ProductEquations> product{};            ///< of more than two dimensions
  std::array<std::optional<CuspEquations>, 2> cusps{};  ///< of the forward, the inverse locus, where they are asked for
  std::string reason{};                                 ///< why nothing but the question is known; empty where all is
};

/// Of the mechanism with, or without, its requirements. Throws as aspects() does.
AspectEquations aspect_equations(study::Question question, bool requirements, bool cusps, const Ended& ended);

}  // namespace corank::analyze
