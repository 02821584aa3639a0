// A C-space with what a path on it is to avoid: its system, the matrices that keep their rank, and, in doubles, what
// planners ask of it.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "corank/analyze/paths/path.h"
#include "corank/certify/compiled_system.h"
#include "corank/core/singularity_types.h"
#include "corank/study/question.h"

namespace corank::analyze {

class PathSpace {
 public:
  /// Throws ModelError where the model has not the inputs or outputs that it takes. Factors of determinants (sign_functions)
  /// are sought for C-spaces of dimension `most_with_factors` at most.
  PathSpace(study::Question question, Avoid avoid, int most_with_factors = 3);

  const study::Question& question() const { return question_; }
  const System& system() const { return system_; }
  int size() const { return system_.size(); }
  /// Of each robot's C-space; negative where there are more equations.
  int dimension() const { return system_.size() - static_cast<int>(system_.equations.size()) - system_.parameters(); }
  /// L_y, L_z or both over the system's variables, and the ranks that they have but at singularities.
  const std::vector<PolynomialMatrix>& matrices() const { return matrices_; }
  const std::vector<int>& ranks() const { return ranks_; }

  /// That a path keeps, where limits of requirements are avoided.
  const KeptDistances& distances() const { return distances_; }

  /// Coordinate j is x_j / sizes()[j], so that distances do not depend on the unit of length.
  using Point = Eigen::VectorXd;
  /// Variable::size.
  const std::vector<double>& sizes() const { return sizes_; }
  std::vector<double> values(const Point& x) const;
  Point middle(const Box& box) const;

  /// Signs ±1, proven for every point of the box, of functions none of which is 0 at a regular configuration: factors of
  /// determinants, and determinants of square matrices; 0 where one is not known. Requires UpwardRounding::active().
  std::vector<int> signs(const Box& box) const;
  /// The number of those functions: where it is 0, no signs tell configurations apart.
  std::size_t sign_functions() const;
  /// Which determinant each of them is or divides, and of a factor its text.
  struct SignFunction {
    Avoid of;
    std::string factor;
  };
  std::vector<SignFunction> sign_names() const;

  /// In doubles, no claims. F, each equation divided by its typical size, and its derivatives by the coordinates of points.
  Eigen::VectorXd residual(const Point& x) const;
  Eigen::MatrixXd jacobian(const Point& x) const;
  /// Moves x to a solution nearby by Newton steps of least change. False: none was found within `reach`.
  bool project(Point& x, double reach = 1e300) const;
  /// An orthonormal basis of the tangent space of one robot's C-space, one vector a column.
  Eigen::MatrixXd tangent(const Point& x) const;
  struct State {
    std::vector<int> signs;  ///< of determinants and of their factors
    /// The least of: the least singular value of each weighted matrix, relative to its largest; by which share of it each
    /// distance is more than it is to be.
    double margin = 0;
    bool inside = false;  ///< the domain and the inequalities, and bodies keep their distances
  };
  State state(const Point& x) const;
  /// May a way pass? Inside, on this side of the singularities, and with this margin at least.
  bool admits(const Point& x, const std::vector<int>& signs, double margin = 0) const;

 private:
  void add_matrix(symbolic::SingularitySet set, bool with_factors);
  double distance_margin(const std::vector<double>& x) const;
  std::vector<double> value_rows(const std::vector<double>& x, int from, int count) const;
  void settle_sizes();

  study::Question question_;
  symbolic::TrigonometricSystem equations_;
  System system_;
  std::vector<double> sizes_, equation_sizes_;
  std::vector<PolynomialMatrix> matrices_;
  std::vector<int> ranks_;
  std::vector<Avoid> blocks_;                  // of the matrices
  std::vector<std::vector<int>> filled_rows_;  // of each matrix, those that are not all 0
  std::vector<Polynomial> factors_;
  std::vector<SignFunction> factor_names_;
  std::unique_ptr<certify::CompiledSystem> compiled_;  // values: the matrices' entries, then the factors
  KeptDistances distances_;
  std::unique_ptr<certify::CompiledSystem> bodies_;  // values: their functions
  std::vector<int> first_entry_;                     // of each matrix among the values
  struct Weights {
    Eigen::VectorXd rows, columns;
  };
  static Weights balancing(const Eigen::MatrixXd& magnitudes);
  std::vector<Weights> weights_;  // of each matrix, by which its entries are of like size whatever the unit of length
};

}  // namespace corank::analyze
