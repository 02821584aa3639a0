// The models of models/planar, which are written as links and joints; and linkages computed without them: loops of vectors,
// in doubles, with Newton's method from many starts.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "corank/solve/search/solve.h"
#include "corank/study/answer.h"
#include "corank/study/model.h"
#include "corank/study/question.h"
#include "corank/tests/cover_lookup.h"

namespace corank::test {

using Constants = std::vector<result::ConstantOverride>;

inline study::Model planar_model(const std::string& name, const Constants& constants = {}) {
  return study::read_model(CORANK_SOURCE_DIR "/models/planar/" + name + ".cuik", constants);
}

inline study::Question ask(const symbolic::Mechanism& mechanism, symbolic::SingularitySet set) {
  study::Question question;
  question.model = mechanism;
  question.set = set;
  return question;
}
inline System set_of(const symbolic::Mechanism& mechanism, symbolic::SingularitySet set) {
  return study::system(ask(mechanism, set));
}
/// With points that are known exactly.
inline Cover answer_to(const symbolic::Mechanism& mechanism, symbolic::SingularitySet set,
                       std::optional<double> sigma = {}) {
  study::Options options;
  options.search.sigma = sigma;
  return study::answer(ask(mechanism, set), options).cover;
}

inline Cover cover_of(const System& system, double sigma_length, double sigma_angle) {
  solve::Options options;
  options.sigma_length = sigma_length;
  options.sigma_angle = sigma_angle;
  return solve::solve(system, options);
}

/// A configuration by the names of its coordinates, angles in radians.
using Configuration = std::map<std::string, double>;

/// The configuration's variables, in the system's order.
inline std::vector<double> variables(const System& system, const Configuration& q) {
  std::vector<double> x(static_cast<std::size_t>(system.configuration_size));
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (system.variables[i].kind != VariableKind::length) continue;
    const auto known = q.find(system.variables[i].name);
    if (known == q.end()) throw std::out_of_range("no value for " + system.variables[i].name);
    x[i] = known->second;
  }
  for (const Angle& angle : system.angles) {
    const auto known = q.find(angle.name);
    if (known == q.end()) throw std::out_of_range("no value for " + angle.name);
    x.at(static_cast<std::size_t>(angle.cosine)) = std::cos(known->second);
    x.at(static_cast<std::size_t>(angle.sine)) = std::sin(known->second);
  }
  return x;
}

inline std::size_t lost(const System& system, const Cover& cover, const std::vector<Configuration>& samples,
                        double tolerance = 1e-7) {
  const CoverLookup lookup(cover);
  return static_cast<std::size_t>(std::count_if(samples.begin(), samples.end(), [&](const Configuration& q) {
    return !lookup.holds(variables(system, q), tolerance);
  }));
}

/// A cover of points: each of the expected ones is one isolated solution, and there are no others.
inline void expect_points(const System& system, const Cover& cover, const std::vector<Configuration>& expected) {
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.points.size(), expected.size());
  for (const Configuration& q : expected) {
    const std::vector<double> x = variables(system, q);
    int holding = 0;
    for (const CoverBox& p : cover.points) {
      bool inside = p.verdict == Verdict::isolated || p.verdict == Verdict::exact;
      for (std::size_t j = 0; j < x.size() && inside; ++j)
        inside = x[j] >= p.box[j].lo() - 1e-6 && x[j] <= p.box[j].hi() + 1e-6;
      holding += inside;
    }
    EXPECT_EQ(holding, 1) << testing::PrintToString(q);
  }
}

/// Σ k e^{iα} = 0 for each loop: closed polygons of vectors; a length x counts as k x.
struct Loops {
  struct Term {
    std::complex<double> k;
    int variable = -1;  ///< index of the angle or the length; −1: k itself
  };
  std::vector<std::string> names;
  std::vector<bool> is_length;
  std::vector<std::vector<Term>> loops;

  Eigen::Index size() const { return static_cast<Eigen::Index>(names.size()); }

  Eigen::VectorXd closure(const Eigen::VectorXd& q) const {
    Eigen::VectorXd f(2 * static_cast<Eigen::Index>(loops.size()));
    for (Eigen::Index l = 0; l < f.size() / 2; ++l) {
      std::complex<double> sum = 0;
      for (const Term& t : loops[static_cast<std::size_t>(l)])
        sum += t.variable < 0 ? t.k : is_length_at(t) ? t.k * q[t.variable] : std::polar(1.0, q[t.variable]) * t.k;
      f[2 * l] = sum.real(), f[2 * l + 1] = sum.imag();
    }
    return f;
  }

  Eigen::MatrixXd jacobian(const Eigen::VectorXd& q) const {
    Eigen::MatrixXd j = Eigen::MatrixXd::Zero(2 * static_cast<Eigen::Index>(loops.size()), size());
    for (Eigen::Index l = 0; l < j.rows() / 2; ++l)
      for (const Term& t : loops[static_cast<std::size_t>(l)]) {
        if (t.variable < 0) continue;
        const std::complex<double> d =
            is_length_at(t) ? t.k : std::complex<double>(0, 1) * t.k * std::polar(1.0, q[t.variable]);
        j(2 * l, t.variable) += d.real(), j(2 * l + 1, t.variable) += d.imag();
      }
    return j;
  }

  /// det of the Jacobian without this column: 0 where the others may move while it stands.
  double locked(const Eigen::VectorXd& q, Eigen::Index column) const {
    const Eigen::MatrixXd j = jacobian(q);
    Eigen::MatrixXd rest(j.rows(), j.cols() - 1);
    rest << j.leftCols(column), j.rightCols(j.cols() - 1 - column);
    return rest.determinant();
  }

  Configuration configuration(const Eigen::VectorXd& q) const {
    Configuration result;
    for (Eigen::Index i = 0; i < size(); ++i) result[names[static_cast<std::size_t>(i)]] = q[i];
    return result;
  }

  /// Configurations of a linkage of mobility 1 that are singular where `name` is locked, by Newton's method from so many
  /// random starts: those that it finds. Lengths start within ± reach.
  std::vector<Configuration> singular(const std::string& name, int starts, double reach = 1) const {
    const auto column = static_cast<Eigen::Index>(std::find(names.begin(), names.end(), name) - names.begin());
    const auto residual = [&](const Eigen::VectorXd& q) {
      Eigen::VectorXd f(size());
      f << closure(q), locked(q, column);
      return f;
    };
    std::mt19937_64 random(20261122);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<Eigen::VectorXd> found;
    for (int k = 0; k < starts; ++k) {
      Eigen::VectorXd q(size());
      for (Eigen::Index i = 0; i < size(); ++i) q[i] = uniform(random) * (is_length_of(i) ? reach : M_PI);
      for (int step = 0; step < 25; ++step) {
        const Eigen::VectorXd f = residual(q);
        if (f.lpNorm<Eigen::Infinity>() < 1e-12) break;
        Eigen::MatrixXd slope(size(), size());
        for (Eigen::Index i = 0; i < size(); ++i) {
          Eigen::VectorXd ahead = q;
          ahead[i] += 1e-7;
          slope.col(i) = (residual(ahead) - f) / 1e-7;
        }
        Eigen::VectorXd way = slope.partialPivLu().solve(f);
        if (!way.allFinite()) break;
        if (const double longest = way.lpNorm<Eigen::Infinity>(); longest > 0.5) way *= 0.5 / longest;
        q -= way;
      }
      if (!(residual(q).lpNorm<Eigen::Infinity>() < 1e-9)) continue;
      if (std::none_of(found.begin(), found.end(), [&](const auto& other) { return same(q, other); })) found.push_back(q);
    }
    std::vector<Configuration> result;
    for (const auto& q : found) result.push_back(configuration(q));
    return result;
  }

 private:
  bool is_length_of(Eigen::Index i) const { return !is_length.empty() && is_length[static_cast<std::size_t>(i)]; }
  bool is_length_at(const Term& t) const { return is_length_of(t.variable); }
  bool same(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
    for (Eigen::Index i = 0; i < size(); ++i) {
      const double d = a[i] - b[i];
      if (std::fabs(is_length_of(i) ? d : std::remainder(d, 2 * M_PI)) > 1e-5) return false;
    }
    return true;
  }
};

}  // namespace corank::test
