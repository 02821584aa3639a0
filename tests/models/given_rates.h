// The repository's models with velocity equations of their own, by twists and joint rates. Where each rate is a function of
// q̇ that is one to one on the solutions of Φ_q q̇ = 0, both forms name the same singular configurations.
#pragma once

#include <string>

#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/kernel_scale.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::test {

/// A model of the repository with these sections behind it.
inline symbolic::Mechanism with_rates(const std::string& model, const std::string& rates) {
  const auto own = symbolic::read_model(CORANK_SOURCE_DIR "/models/" + model + ".cuik");
  return symbolic::parse_model(own.source_text() + rates, model + ".cuik");
}

/// As a study has it: with passive rates eliminated and the kernel scaled.
inline System study_system(const symbolic::Mechanism& m, symbolic::SingularitySet set,
                           std::optional<symbolic::KernelSide> side = std::nullopt) {
  if (!definition(set).has_kernel()) return algebrize(singularity_system(m, set));
  const auto kernel = without_passive_rates(m, kernel_question(m, set, side));
  return algebrize(singularity_system(m, kernel, kernel_scales(m, kernel), 1));
}

// Three sliders: the rod from A turns by w1, v_C = y_A w1 and v_A = -x_C w1; that from B by w2.
inline const char* const kRodRates =
    "[RATES]\nv_A : input\nv_B : output\nv_C : passive\nw1 ~ passive\nw2 ~ passive\n[VELOCITY EQS]\n"
    "v_C = y_A*w1;\nv_A + x_C*w1 = 0;\nv_C = y_B*w2;\nv_B + x_C*w2 = 0;\n";

// Dextar: the relative rates of its joints J5, J4, J3, J2, J1, whose twists (1; y, -x) add up to nothing about the loop, and
// the velocity of J3.
inline const char* const kJointRates =
    "[RATES]\nw5 ~ input\nw4 ~ passive\nw3 ~ passive\nw2 ~ passive\nw1 ~ input\nvx : output\nvy : output\n[VELOCITY EQS]\n"
    "w5 + w4 + w3 + w2 + w1 = 0;\n"
    "w4*l5*sin(theta5) + w3*J3y + w2*l2*sin(theta2) = 0;\n"
    "w4*l5*cos(theta5) + w3*J3x + w2*(d + l2*cos(theta2)) + w1*d = 0;\n"
    "vx = -w5*J3y - w4*(J3y - l5*sin(theta5));\n"
    "vy =  w5*J3x + w4*(J3x - l5*cos(theta5));\n";
// The same with the links' absolute rates.
inline const char* const kLinkRates =
    "[RATES]\nw2 ~ input\nw5 ~ input\nw3 ~ passive\nw4 ~ passive\nvx : output\nvy : output\n[VELOCITY EQS]\n"
    "-l2*sin(theta2)*w2 - l3*sin(theta3)*w3 - l4*sin(theta4)*w4 + l5*sin(theta5)*w5 = 0;\n"
    "l2*cos(theta2)*w2 + l3*cos(theta3)*w3 + l4*cos(theta4)*w4 - l5*cos(theta5)*w5 = 0;\n"
    "vx = -l2*sin(theta2)*w2 - l3*sin(theta3)*w3;\n"
    "vy =  l2*cos(theta2)*w2 + l3*cos(theta3)*w3;\n";

// The planar 3-RRR: the platform's twist about C1 and the motors' rates alone, by screws that the passive joints do no work
// on: forces along the links B_i C_i.
inline const char* const kLegScrews =
    "[RATES]\nw ~ output\nvx : output\nvy : output\nt1 ~ input\nt2 ~ input\nt3 ~ input\n[VELOCITY EQS]\n"
    "cos(psi1)*vx + sin(psi1)*vy = l1*sin(psi1 - theta1)*t1;\n"
    "cos(psi2)*(vx - p*sin(phi)*w) + sin(psi2)*(vy + p*cos(phi)*w) = l1*sin(psi2 - theta2)*t2;\n"
    "cos(psi3)*(vx - p*sin(phi+pi/3)*w) + sin(psi3)*(vy + p*cos(phi+pi/3)*w) = l1*sin(psi3 - theta3)*t3;\n";

// The spherical five-bar: angular velocities about z, e1, w, e2, x add up to nothing about the loop; the output is the
// velocity of w along e1 × w and along e1 - (e1·w) w, both tangents of constant length.
inline const char* const kAngularVelocities =
    "[RATES]\nt1 ~ input\nt2 ~ input\na1 ~ passive\na2 ~ passive\nb ~ passive\nu1 ~ output\nu2 ~ output\n[VELOCITY EQS]\n"
    "a1*s*cos(theta1) + b*w_x - a2*c - t2 = 0;\n"
    "a1*s*sin(theta1) + b*w_y - a2*s*cos(theta2) = 0;\n"
    "t1 + a1*c + b*w_z - a2*s*sin(theta2) = 0;\n"
    "u1 = t1*(c - k*w_z) + a1*(1 - k^2);\n"
    "u2 = t1*(w_x*s*sin(theta1) - w_y*s*cos(theta1));\n";

}  // namespace corank::test
