#include "corank/study/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "corank/kinematics/language/part_file.h"
#include "corank/kinematics/urdf/urdf.h"
#include "corank/solve/reduction/reducer.h"
#include "corank/symbolic/algebra/exact_value.h"
#include "corank/symbolic/model/evaluate.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/singularity_system.h"
#include "corank/symbolic/writing/printer.h"

namespace corank::study {
namespace {

using symbolic::ModelError;

void put_in(const std::vector<result::ConstantOverride>& overrides, kinematics::Robot& robot) {
  for (const result::ConstantOverride& o : overrides) {
    const auto known = std::ranges::find_if(robot.constants, [&](const auto& c) { return c.name == o.name; });
    if (known == robot.constants.end())
      throw ModelError({robot.file, 0, 0}, "there is no constant '" + o.name + "'", "a constant of the robot");
    const symbolic::Constant read = symbolic::parse_constant(o.name, o.expression, "-D " + o.name);
    known->value = read.value;
    known->tolerance = read.tolerance;
  }
}

// Throws ModelError where the equations that belong to the nominal values are not proven to hold for every other one.
void put_in_tolerances(const std::vector<symbolic::Constant>& constants, kinematics::Assembly& assembly) {
  std::vector<symbolic::Constant> toleranced;
  std::vector<symbolic::Parameter> parameters;
  for (const symbolic::Constant& c : constants) {
    if (!c.tolerance || !assembly.mechanism.has_constant(c.name)) continue;
    toleranced.push_back(c);
    parameters.push_back({c.name, c.tolerance->lower, c.tolerance->upper});
  }
  symbolic::check_conditions(assembly.mechanism, assembly.conditions, parameters);
  for (const symbolic::Constant& c : toleranced) assembly.mechanism.set_constant(c.name, c.value, c.tolerance);
}

// Joints that leave other freedom than they count for, and whether the equations are as many as the robot's freedom.
std::optional<std::string> paradox(const kinematics::Assembly& assembly) {
  if (!assembly.mobility_by_rank || *assembly.mobility_by_rank <= assembly.mobility) return std::nullopt;
  // Of which some may be 0 = 0, or repeat others, once variables are replaced exactly: searches go without them, with proof.
  const System system = symbolic::algebrize(symbolic::plain_system(assembly.mechanism));
  const int seen = *assembly.mobility_by_rank - assembly.mobility;
  const int more = std::min(seen, kinematics::sampled_redundancy(solve::reduce(system).system).value_or(seen));
  if (more == 0) return std::nullopt;
  return fmt::format(
      "by their number, its equations leave {} degree{} of freedom, but at sampled configurations they leave {}: {} of them "
      "follow{} from the others there (a paradoxical or over-constrained linkage), so boxes are proven for independent "
      "equations only (partial)",
      assembly.mobility, assembly.mobility == 1 ? "" : "s", *assembly.mobility_by_rank, more, more == 1 ? "s" : "");
}

// Written-out parallelograms close in other ways, too.
std::string flat_positions(const kinematics::Assembly::WrittenParallelogram& p) {
  const std::string sides = fmt::format("{}", fmt::join(p.sides, ", "));
  const std::string keep = "the line `keep parallelograms` under [JOINTS] keeps only the parallelogram";
  if (p.angle.empty())
    return fmt::format(
        "{} are a parallelogram: where it is flat it can also fold crosswise, and boxes about such "
        "positions may stay undecided; {}",
        sides, keep);
  return fmt::format(
      "{} are a parallelogram that can also fold {}: {} = 0 where it is a parallelogram, {} where it is not. "
      "Where these meet, at flat positions, it is singular; {}",
      sides, p.is_rhombus ? "upon itself" : "crosswise", p.angle, p.is_rhombus ? "pi/2 or pi" : "pi", keep);
}

// Joints whose output has another name: that of a coordinate is the joint's, in every command.
std::optional<std::string> other_names(const kinematics::Robot& robot) {
  std::string list;
  for (const kinematics::Output& o : robot.outputs) {
    if (o.kind != kinematics::Output::Kind::joint || o.name == robot.joints[o.joint].name) continue;
    list += (list.empty() ? "" : ", ") + o.name + " is " + robot.joints[o.joint].name;
  }
  if (list.empty()) return std::nullopt;
  return "an output that is a joint has the joint's name, here and in results: " + list;
}

// Those of a robot's joints that are angles, with the ranges that their author gave them.
std::vector<symbolic::Coordinate> angles_of(const kinematics::Robot& robot) {
  std::vector<symbolic::Coordinate> list;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const kinematics::Joint& joint = robot.joints[j];
    if (joint.kind == kinematics::JointKind::revolute && joint.range() && !robot.is_coupled(j))
      list.push_back({joint.name, symbolic::CoordinateKind::angle, joint.range()->lower, joint.range()->upper, {}});
  }
  return list;
}

// Ranges of angles that look like degrees: they limit nothing.
void note_wide_ranges(const std::vector<symbolic::Coordinate>& coordinates, Model& model) {
  constexpr double kMost = 12 * std::numbers::pi;  // more turns than joints without gears make
  const std::map<std::string, double> values = symbolic::constant_values(model.mechanism);
  std::string list;
  for (const symbolic::Coordinate& c : coordinates)
    if (c.kind == symbolic::CoordinateKind::angle && evaluate(c.upper, values) - evaluate(c.lower, values) > kMost)
      list += (list.empty() ? "" : ", ") + c.name;
  if (!list.empty())
    model.notices.push_back(fmt::format(
        "the range of {} is more than six turns and limits nothing; numbers are radians, 90 degrees are 90deg", list));
}

// Poses in one orientation, of which the position alone is an output (kinematics::assemble).
std::optional<std::string> only_positions(const kinematics::Robot& robot, const kinematics::Assembly& assembly) {
  std::string list;
  const auto& rates = assembly.mechanism.rates();
  for (const kinematics::Output& o : robot.outputs) {
    const bool turns =
        std::ranges::any_of(rates, [&](const symbolic::Rate& rate) { return rate.name.starts_with("w_" + o.name + "_"); });
    if (o.kind != kinematics::Output::Kind::pose || !o.kept || turns || rates.empty()) continue;
    list += (list.empty() ? "" : ", ") + o.name;
  }
  if (list.empty()) return std::nullopt;
  return fmt::format(
      "the robot has mobility {}, fewer than a pose has: of {} the position is the output, in the orientation that is kept",
      assembly.mobility, list);
}

Model from_robot(kinematics::Robot robot, const std::vector<result::ConstantOverride>& constants) {
  put_in(constants, robot);
  if (!robot.missing.empty()) throw ModelError({robot.file, 0, 0}, robot.missing.front(), "all files that the robot names");
  Model model{symbolic::Mechanism(robot.name), kinematics::assemble(robot), robot.notices};
  put_in_tolerances(robot.constants, *model.assembly);
  model.mechanism = model.assembly->mechanism;
  const std::string file = std::filesystem::path(robot.file).filename().string();
  if (!model.mechanism.coordinates().empty())
    model.mechanism.set_source_text("% The equations of " + file + ": " + describe(*model.assembly) + ".\n" +
                                    symbolic::to_model(model.mechanism));
  for (const auto& one : model.assembly->parallelograms) model.notices.push_back(flat_positions(one));
  if (const auto names = other_names(robot)) model.notices.push_back(*names);
  note_wide_ranges(angles_of(robot), model);
  if (const auto positions = only_positions(robot, *model.assembly)) model.notices.push_back(*positions);
  if (const auto special = paradox(*model.assembly)) model.notices.push_back(*special);
  return model;
}

}  // namespace

std::string describe(const kinematics::Assembly& assembly) {
  std::string text = fmt::format("{}, {} links, mobility {}", to_string(assembly.space), assembly.links, assembly.mobility);
  if (assembly.mobility_by_joints != assembly.mobility)
    text += fmt::format(" ({} by its joints only)", assembly.mobility_by_joints);
  return text;
}

ModelText read_text(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.parent_path();
  return {symbolic::read_text(path), path.string(), folder.empty() ? std::filesystem::path(".") : folder};
}

Model parse_model(const ModelText& model, const std::vector<result::ConstantOverride>& constants,
                  const std::optional<ModelText>& loops) {
  const std::string extension = std::filesystem::path(model.file).extension();
  if (extension == ".urdf") {
    std::optional<kinematics::UrdfLoops> companion;
    if (loops) companion = {loops->text, loops->file};
    return from_robot(kinematics::parse_urdf(model.text, model.file, companion), constants);
  }
  if (loops)
    throw ModelError({model.file, 0, 0}, "only a URDF file has a companion with its loops", "a file that ends in .urdf");
  if (extension == ".world" || kinematics::has_parts(model.text))
    return from_robot(kinematics::parse_parts(model.text, model.file, model.folder), constants);
  Model read{symbolic::parse_model(model.text, model.file), {}, {}};
  result::put_in(constants, read.mechanism);
  for (const result::ConstantOverride& o : constants)  // whether or not an equation has it
    symbolic::exact_value(read.mechanism, symbolic::Expression::symbol(o.name), o.name);
  note_wide_ranges(read.mechanism.coordinates(), read);
  return read;
}

Model read_model(const std::filesystem::path& path, const std::vector<result::ConstantOverride>& constants,
                 const std::optional<std::filesystem::path>& loops) {
  std::optional<ModelText> companion;
  if (loops) companion = read_text(*loops);
  return parse_model(read_text(path), constants, companion);
}

void require(const std::vector<std::string>& texts, Model& model) {
  if (texts.empty()) return;
  std::string section = "\n[REQUIREMENTS]\n";
  for (const std::string& text : texts) {
    model.mechanism.require(text);
    section += text + ";\n";
  }
  model.mechanism.set_source_text(model.mechanism.source_text() + section);
}

}  // namespace corank::study
