// A question about a mechanism as a plain value: which set of which model; and the system whose solutions answer it.
#pragma once

#include <optional>
#include <vector>

#include "corank/core/system.h"
#include "corank/kinematics/equations/assembly.h"
#include "corank/result/values/result.h"
#include "corank/solve/step/control.h"
#include "corank/symbolic/sets/set_parts.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::study {

struct Question {
  symbolic::Mechanism model;                          ///< with its constants put in (result::put_in)
  std::optional<symbolic::SingularitySet> set{};      ///< nothing: the equations of the model themselves
  std::optional<symbolic::KernelSide> kernel{};       ///< nothing: the default of symbolic::singularity_system
  int corank = 1;                                     ///< the kernel's dimension, at least, of the configurations asked for
  std::vector<result::ConstantOverride> constants{};  ///< those that were put in, for the record
  std::optional<kinematics::Assembly> assembly{};     ///< of a robot from parts: results say where its links are
  std::vector<std::string> outputs{};       ///< that were put in (result::put_in), for the record: of a workspace boundary
  std::optional<bool> in_parts{};           ///< is a union solved part by part? Nothing: parts_of() decides
  std::optional<symbolic::SetPart> part{};  ///< which one
  std::optional<double> tolerance{};  ///< of coefficients, relative; nothing: printed_tolerance() of a plain system, else 0
};

/// Throws ModelError where a constant is known within a tolerance only: `asker` answers for one robot.
void require_exact_constants(const symbolic::Mechanism& model, const std::string& asker);

/// Throws ModelError where the value depends on such a constant: `what` ("the centre") has to be the same for all robots.
void require_exact_value(const symbolic::Mechanism& model, const symbolic::Expression& value, const std::string& what);

/// Of a set that is solved in parts the question about each of them (symbolic/sets/set_parts.h); of another set the question
/// itself. A union, or a set that has an equation in place of the kernel vector, is solved so where it has dimension 2 or
/// more, or the robot has written-out parallelograms, along whose flat positions parts coincide; where it is asked for
/// without a kernel's side or corank, and `in_parts` does not say otherwise. So is a curve or points where the kernel vector
/// would have ten unknowns or more, of an arm six, and no part has one. Other curves and points are few boxes either way,
/// and the kernel vector of the whole says more. Throws symbolic::ModelError. `ended`: as decompose().
std::vector<Question> parts_of(const Question& question, const Ended& ended = {});

/// The equations of the set, its kernel vectors scaled (symbolic/sets/kernel_scale.h); of a set of parts those of
/// question.part. Throws symbolic::ModelError.
symbolic::TrigonometricSystem equations(const Question& question);

/// equations() of each of the parts_of() the question, of a union only where `in_parts` asks for its parts, whose names
/// the systems then have. Throws ModelError also where an implied equation does not follow. Once `ended` is true, those that
/// are made by then.
std::vector<symbolic::TrigonometricSystem> equations_of_parts(Question question, const Ended& ended = {});

/// equations() as polynomials, the system that is solved, each variable with its
/// typical size: 1 of sines, cosines and kernel vectors, the same of all lengths. Throws symbolic::ModelError.
System system(const Question& question);
System system(const Question& question, const symbolic::TrigonometricSystem& equations);

/// The parts of a question, each with its system.
struct Systems {
  std::vector<Question> parts;
  std::vector<System> of_parts;  ///< as many, if they are to be whole
};

/// parts_of() and system(), in the stage `model` of the control, which notes where it ends. Unless the systems are to be
/// whole, no more are made once the control has ended.
Systems systems_of(const Question& question, solve::Control& control, bool whole = true);

}  // namespace corank::study
