// A robot written in parts, assembled; poses of its links in numbers, where its joints' coordinates are given.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "corank/kinematics/equations/assembly.h"
#include "corank/kinematics/language/part_file.h"
#include "corank/symbolic/model/evaluate.h"
#include "corank/tests/kinematics/transform.h"

namespace corank::kinematics {

inline Assembly assembled(const std::string& parts) { return assemble(parse_parts(parts, "r.cuik")); }

/// What is wrong with these parts: "none" where nothing is.
inline std::string fault_of(const std::string& parts) {
  try {
    assembled(parts);
  } catch (const symbolic::ModelError& error) {
    return error.what();
  }
  return "none";
}

inline std::vector<std::string> coordinate_names(const Assembly& a) {
  std::vector<std::string> names;
  for (const symbolic::Coordinate& c : a.mechanism.coordinates()) names.push_back(c.name);
  return names;
}

/// All coordinates where some are known: as long as an equation has one unknown, in which it is linear, that one follows.
/// Expects that all equations hold then.
inline std::map<std::string, double> completed(const Assembly& a, std::map<std::string, double> values) {
  for (const symbolic::Constant& c : a.mechanism.constants()) values[c.name] = symbolic::evaluate(c.value, values);
  const auto open = [&](const symbolic::Constraint& c) {
    return symbolic::evaluate(c.relation.lhs, values) - symbolic::evaluate(c.relation.rhs, values);
  };
  for (bool found = true; found;) {
    found = false;
    for (const symbolic::Constraint& c : a.mechanism.constraints()) {
      std::vector<std::string> unknown;
      for (const symbolic::Coordinate& coordinate : a.mechanism.coordinates())
        if (!values.contains(coordinate.name) && c.relation.lhs.mentions(coordinate.name))
          unknown.push_back(coordinate.name);
      if (unknown.size() != 1) continue;
      double& value = values[unknown[0]];
      value = 0;
      const double at_zero = open(c);
      value = 1;
      value = at_zero / (at_zero - open(c));
      found = true;
    }
  }
  for (const symbolic::Constraint& c : a.mechanism.constraints())
    if (c.relation.kind == symbolic::Relation::Kind::equal) {
      EXPECT_NEAR(open(c), 0, 1e-9) << c.relation.text();
    }
  return values;
}

inline Transform pose_of(const Assembly& a, const std::string& link, const std::map<std::string, double>& values) {
  for (const Assembly::LinkPose& pose : a.poses) {
    if (pose.link != link) continue;
    Transform result;
    for (std::size_t i = 0; i < 3; ++i) {
      result.p[i] = symbolic::evaluate(pose.origin[i], values);
      for (std::size_t k = 0; k < 3; ++k) result.r[i][k] = symbolic::evaluate(pose.rotation[i][k], values);
    }
    return result;
  }
  throw std::runtime_error("no link " + link);
}

inline void expect_same(const Transform& a, const Transform& b, const std::string& what) {
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(a.p[i], b.p[i], 1e-9) << what;
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a.r[i][k], b.r[i][k], 1e-9) << what;
  }
}

}  // namespace corank::kinematics
