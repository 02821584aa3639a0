// What expressions in a robot's constants are worth, exactly.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "corank/symbolic/mechanism.h"

namespace corank::kinematics {

/// Every function throws ModelError for a name that is no constant defined before, an absurd power, and what is no real
/// number; with the expression's place where it has one, else `where`. Messages call the expression `owner`.
/// A scope holds a GinacLock while it lives, and dies in the thread that made it.
class ConstantScope {
 public:
  ConstantScope();
  explicit ConstantScope(const std::vector<symbolic::Constant>& constants);
  ~ConstantScope();
  ConstantScope(ConstantScope&&) noexcept;
  ConstantScope& operator=(ConstantScope&&) noexcept;

  /// Throws also for a name that is taken or reserved.
  void define(const symbolic::Constant& constant);
  bool has(const std::string& name) const;
  std::vector<std::string> names() const;

  void check(const symbolic::Expression& e, const std::string& owner, const symbolic::SourceLocation& where);
  /// Nothing where enclosures leave it open: it may be 0.
  std::optional<int> sign(const symbolic::Expression& e, const std::string& owner, const symbolic::SourceLocation& where);
  /// The integer that the value is recognized as.
  std::optional<int> integer(const symbolic::Expression& e, const std::string& owner, const symbolic::SourceLocation& where);
  /// Close to the value; for drawing.
  double approximation(const symbolic::Expression& e, const std::string& owner, const symbolic::SourceLocation& where);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace corank::kinematics
