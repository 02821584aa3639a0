// Vectors and poses of expressions. Zeros and ones that are written as such are folded, nothing else is.
#pragma once

#include "corank/kinematics/robot/robot.h"

namespace corank::kinematics {

/// Written as 0, "0.0" …
bool is_literal_zero(const Expression& e);
bool is_literal_one(const Expression& e);

Expression folded_sum(const Expression& a, const Expression& b);
Expression folded_difference(const Expression& a, const Expression& b);
Expression folded_product(const Expression& a, const Expression& b);

Vector operator+(const Vector& a, const Vector& b);
Vector operator-(const Vector& a, const Vector& b);
Vector cross(const Vector& a, const Vector& b);
Expression dot(const Vector& a, const Vector& b);

/// The frame that b describes in the frame that a describes.
Pose operator*(const Pose& a, const Pose& b);
/// Of a rotation matrix and a translation.
Pose inverse(const Pose& pose);

Pose translation(const Vector& by);
/// About x, y or z (0, 1, 2). Multiples of a quarter turn, written with numbers and pi only, give zeros and ones.
Pose rotation(int axis, const Expression& angle);
/// The same by an angle with this cosine and sine.
Pose rotation(int axis, const Expression& cosine, const Expression& sine);

}  // namespace corank::kinematics
