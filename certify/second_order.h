// First and second derivatives of functions along a sheet, over all of a box.
#pragma once

#include <optional>
#include <vector>

#include "corank/certify/inertia.h"
#include "corank/core/cover.h"
#include "corank/core/system.h"

namespace corank::certify {

/// By the free variables, in their order.
struct SheetDerivatives {
  std::vector<Interval> first;
  IntervalMatrix second{0, 0};
};

/// Enclose Df and D²f over the box: the natural extension of each derivative. Require UpwardRounding::active().
std::vector<Interval> gradient(const Polynomial& f, const Box& x);
IntervalMatrix hessian(const Polynomial& f, const Box& x);

/// Of f(x(u)) for each of the functions, where F(x(u)) = 0 is the sheet over the free variables u, at all of its points
/// in the box; nothing where that is not shown. Requires UpwardRounding::active(). Theorem: the columns V_i of
/// kernel_basis() are ∂x/∂u_i. A second derivative of F(x(u)) = 0 gives F_D·w_ij = −V_iᵀ D²F V_j for the dependent
/// block w_ij of ∂²x/∂u_i∂u_j, whose free block is 0; so [w_ij; 1] is the kernel of [F_D, V_iᵀ D²F V_j], and ∂²f = V_iᵀ
/// D²f V_j + D_D f·w_ij.
std::optional<std::vector<SheetDerivatives>> sheet_derivatives(const System& system, const std::vector<int>& free,
                                                               const Box& box, const std::vector<Polynomial>& functions);

}  // namespace corank::certify
