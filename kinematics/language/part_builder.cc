#include "corank/kinematics/language/part_builder.h"

#include <algorithm>

#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::kinematics {

using symbolic::in_quotes;
using symbolic::ModelError;
using symbolic::suggestion;

namespace {

std::string canonical_name(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path real = std::filesystem::weakly_canonical(path, error);
  return error ? path.string() : real.string();
}

}  // namespace

std::string small_letters(std::string_view word) {
  std::string result(word);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

PartBuilder::PartBuilder(const std::string& file_, std::optional<std::filesystem::path> folder_given)
    : ModelBuilder(file_), folder_(std::move(folder_given)) {
  const std::filesystem::path path(file_);
  is_world_ = path.extension() == ".world";
  robot.file = file_;
  robot.name = path.stem().string();
  if (folder_) open_files_.push_back(canonical_name(*folder_ / path.filename()));
}

void PartBuilder::go_on_with(const Robot& begun) {
  goes_on_ = true;
  robot = begun;
  for (const symbolic::Constant& constant : robot.constants) scope.define(constant);
  link_data_.resize(robot.links.size());
}

void PartBuilder::pass_over(const std::string& what) {
  for (auto& [passed, count] : passed_over_) {
    if (passed != what) continue;
    ++count;
    return;
  }
  passed_over_.emplace_back(what, 1);
}

std::string PartBuilder::resolve(std::string_view name_read) const {
  std::string result = prefix_;
  for (char c : name_read) result += c == ':' ? '_' : c;  // a::b is a__b
  return result;
}

void PartBuilder::push_constant(std::string_view name_read, const SourceLocation& where) {
  if (small_letters(name_read) == "pi" || name_read == "deg") {
    expressions.symbol(small_letters(name_read), where);
    return;
  }
  const std::string resolved = resolve(name_read);
  if (!scope.has(resolved) && dh.reads_cells) {
    dh.variables.push_back({std::string(name_read), where, dh.cells.size()});
    expressions.symbol(resolved, where);
    return;
  }
  if (!scope.has(resolved))
    throw ModelError(where, "the constant " + in_quotes(name_read) + " is not defined before",
                     "a constant of [CONSTANTS]" + suggestion(resolved, scope.names()));
  expressions.symbol(resolved, where);
}

void PartBuilder::define_constant() {
  const symbolic::Constant constant{resolve(declared), pop_value(), declared_where, std::exchange(tolerance, {})};
  if (scope.has(constant.name)) {
    const auto first =
        std::ranges::find_if(robot.constants, [&](const symbolic::Constant& c) { return c.name == constant.name; });
    throw ModelError(
        declared_where,
        "the constant " + in_quotes(declared) + " is already defined in line " + std::to_string(first->where.line),
        "another name for the constant");
  }
  scope.define(constant);
  if (constant.name != "deg") robot.constants.push_back(constant);
}

std::size_t PartBuilder::require_link(const ReadName& link, const std::string& expectation) const {
  const int found = robot.find_link(link.text);
  if (found < 0 && goes_on_ && link.text == "ground") return 0;
  if (found < 0)
    throw ModelError(link.where, "there is no link " + in_quotes(link.text),
                     expectation + suggestion(link.text, symbolic::names_of(robot.links)));
  return found;
}

std::size_t PartBuilder::require_joint(const ReadName& joint, const std::string& expectation) const {
  const int found = robot.find_joint(joint.text);
  if (found < 0)
    throw ModelError(joint.where, "there is no joint " + in_quotes(joint.text),
                     expectation + suggestion(joint.text, symbolic::names_of(robot.joints)));
  return found;
}

void PartBuilder::add_input(std::string_view name_read, const SourceLocation& where) {
  const std::string joint = resolve(name_read);
  for (const ReadName& known : named_inputs_)
    if (known.text == joint)
      throw ModelError(where, "the joint " + in_quotes(joint) + " is an input already", "each input once");
  named_inputs_.push_back({joint, where});
}

void PartBuilder::finish_output_range(const SourceLocation& where) {
  const std::array<const char*, 4> names{"x", "y", "z", "phi"};
  const std::string of =
      std::string("the range of ") + names[output_axis] + " of the output " + in_quotes(output.output.name);
  if (!bracket_has_two) throw ModelError(where, of + " has one number", "[lower, upper]");
  const Expression upper = pop_value(), lower = pop_value();
  std::optional<Range>& range = output_axis == 3 ? output.output.turn : output.output.ranges[output_axis];
  if (range) throw ModelError(where, of + " is given twice", "one range for each component");
  range = Range{lower, upper};
}

void PartBuilder::begin_only(const SourceLocation& where) {
  Output& of = output.output;
  if (!of.asked[0] || !of.asked[1] || !of.asked[2])
    throw ModelError(where, "the output " + in_quotes(of.name) + " says only twice", "all of its components once");
  of.asked = {};
}

void PartBuilder::finish_output() {
  output.output.name = resolve(output.output.name);
  outputs_.push_back(output);
}

void PartBuilder::resolve_outputs() {
  for (const OutputDraft& read : outputs_) {
    Output& result = robot.outputs.emplace_back(read.output);
    if (read.kind == "joint") {
      result.kind = Output::Kind::joint;
      result.joint = require_joint(read.joint, "the name of a joint");
      continue;
    }
    result.kind = read.kind == "position"      ? Output::Kind::position
                  : read.kind == "pose"        ? Output::Kind::pose
                  : read.kind == "orientation" ? Output::Kind::orientation
                                               : Output::Kind::direction;
    result.link = require_link(read.link, "the name of a link");
    if (!read.frame.text.empty()) result.relative_to = require_link(read.frame, "the name of a link");
    const bool has_point = !read.point.text.empty();
    if (result.kind == Output::Kind::direction && !read.vector)
      throw ModelError(result.where, "the direction of " + in_quotes(result.name) + " is not given",
                       "direction of link (x, y, z)");
    if (result.kind == Output::Kind::orientation && (read.vector || has_point))
      throw ModelError(result.where, "the orientation of " + in_quotes(result.name) + " is given with a point",
                       "orientation of link");
    if (result.kind == Output::Kind::direction && has_point)
      throw ModelError(result.where, "the direction of " + in_quotes(result.name) + " is given as a point",
                       "direction of link (x, y, z)");
    if (read.vector) result.point = *read.vector;
    if (has_point) result.point = require_point(result.link, read.point);
  }
}

void PartBuilder::include(const std::string& prefix_read) {
  if (!folder_)
    throw ModelError(quoted_where, "the file " + in_quotes(quoted) + " cannot be included: this text has no folder",
                     "a robot read from a file");
  const std::filesystem::path path = *folder_ / quoted;
  const std::string key = canonical_name(path);
  if (std::ranges::find(open_files_, key) != open_files_.end())
    throw ModelError(quoted_where, "the file " + in_quotes(quoted) + " includes itself, directly or through others",
                     "a file that does not include this one");
  if (open_files_.size() > kMaxIncludeDepth || ++includes_ > kMaxIncludes)
    throw ModelError(
        quoted_where, "too many files are included",
        "at most " + std::to_string(kMaxIncludes) + ", " + std::to_string(kMaxIncludeDepth) + " inside one another");
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw ModelError(quoted_where, "the included file " + in_quotes(quoted) + " is not there",
                     "a file of links and joints in " + folder_->string());
  const std::string text_included = symbolic::read_text(path);
  const auto saved = std::tuple(file, folder_, prefix_, text);
  file = path.string();
  folder_ = path.parent_path();
  prefix_ += prefix_read + "__";
  open_files_.push_back(key);
  parse_included(text_included);
  open_files_.pop_back();
  std::tie(file, folder_, prefix_, text) = saved;
}

// Its names are those of the whole robot's coordinates, bodies and points.
void PartBuilder::add_requirement(std::string line, const SourceLocation& where) {
  if (!prefix_.empty()) return pass_over("requirements of an included file");
  line.resize(line.find_last_not_of(" \t\r\n") + 1);
  robot.requirements.push_back({std::move(line), where});
}

void PartBuilder::read_equations() {
  const std::string what = quoted_where.text() + ": the equations of " + in_quotes(quoted) + ": ";
  if (!folder_) {
    robot.missing.push_back(what + "this text has no folder");
    return;
  }
  const std::filesystem::path path = *folder_ / quoted;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    robot.missing.push_back(what + "there is no such file");
    return;
  }
  const symbolic::Mechanism read = symbolic::parse_fragment(symbolic::read_text(path), path.string());
  if (!read.coordinates().empty()) {
    robot.missing.push_back(what + "it declares variables of its own");
    return;
  }
  for (const symbolic::Constant& constant : read.constants()) {
    scope.define(constant);
    robot.constants.push_back(constant);
  }
  robot.equations.insert(robot.equations.end(), read.constraints().begin(), read.constraints().end());
}

// The suite's files hold links that no joint holds, to be looked at, or to float freely: neither is part of a mechanism.
void PartBuilder::leave_out_unconnected_links() {
  std::vector<bool> held(robot.links.size(), false);
  if (!held.empty()) held[0] = true;
  for (bool grows = true; grows;) {
    grows = false;
    for (const Joint& joint : robot.joints) {
      const bool first = held[joint.ends[0].link], second = held[joint.ends[1].link];
      if (first == second) continue;
      held[joint.ends[0].link] = held[joint.ends[1].link] = grows = true;
    }
  }
  std::vector<std::size_t> index(held.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < held.size(); ++i) {
    index[i] = kept;
    if (held[i]) {
      if (kept != i) robot.links[kept] = std::move(robot.links[i]);
      ++kept;
    } else {
      robot.notices.push_back("the link " + in_quotes(robot.links[i].name) +
                              " is left out: no joint connects it with the ground");
    }
  }
  if (kept == held.size()) return;
  robot.links.resize(kept);
  std::erase_if(robot.joints, [&](const Joint& joint) { return !held[joint.ends[0].link]; });
  for (Joint& joint : robot.joints)
    for (JointEnd& end : joint.ends) end.link = index[end.link];
}

void PartBuilder::finish() {
  for (const ReadName& input : named_inputs_) {
    Joint& joint = robot.joints[require_joint(input, "the name of a joint")];
    if (joint.actuated)
      throw ModelError(input.where, "the joint " + in_quotes(input.text) + " is actuated already",
                       "`actuated` after the joint, or the joint in [INPUTS]");
    joint.actuated = true;
  }
  resolve_outputs();
  ask_for_what_dh_leaves_open();
  set_zero_directions();
  if (is_world_ && outputs_.empty()) leave_out_unconnected_links();
  resolve_couplings();
  for (const auto& [what, count] : passed_over_)
    robot.notices.push_back(what + (count == 1 ? ": once" : ": " + std::to_string(count) + " times"));
  robot.validate();
}

}  // namespace corank::kinematics
