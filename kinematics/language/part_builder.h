// What the actions of the parts language build: a Robot, statement by statement. Faults ask it what was read last.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "corank/kinematics/robot/constant_scope.h"
#include "corank/kinematics/robot/robot.h"
#include "corank/symbolic/model/model_builder.h"

namespace corank::kinematics {

// The rows by which data sheets give an arm: four numbers for each joint, after Denavit and Hartenberg, "A kinematic
// notation for lower-pair mechanisms based on matrices", 1955 (key Denavit1955).
enum class DhConvention {
  standard,  ///< a row is Rz(theta) Tz(d) Tx(a) Rx(alpha): its frame stands at the link's far end
  modified   ///< a row is Rx(alpha) Tx(a) Rz(theta) Tz(d) (Craig): its frame stands on the joint's axis
};

/// Of one joint: `theta` and `d` where the joint's own coordinate is 0.
struct DhRow {
  Expression a = 0, alpha = 0, d = 0, theta = 0;
};

/// The row's frame in that of the row before it, the joint at 0.
Pose dh_pose(DhConvention convention, const DhRow& row);

/// The joint's ends in the frames of the row before it and of the row: its axis is z, or −z for a negative sense, and its
/// coordinate counts from where dh_pose() has the frames.
std::array<JointEnd, 2> dh_ends(DhConvention convention, const DhRow& row, int sense);

/// A body in Geomview's OFF and COFF formats, as far as a robot needs it: vertices, which joints may name by number, and
/// faces.
struct OffBody {
  std::vector<Vector> vertices;  ///< exactly as written
  std::vector<std::vector<std::size_t>> faces;
};

/// Throws ModelError with the line where the text is no such body, or is longer than a model may be.
OffBody parse_off(std::string_view text, const std::string& file);

/// A point as read: `way` from the one before it where it was written + (v).
struct ReadPoint {
  Vector at;
  std::optional<Vector> way;
  SourceLocation where;
  std::string name{};  ///< where it was written by its name
};

/// A name as it is read, with the prefix of its file.
struct ReadName {
  std::string text;
  SourceLocation where;
};

/// The joint, or the spring, being read.
struct JointDraft {
  struct Bracket {
    Expression first;
    std::optional<Expression> second;
    SourceLocation where;
  };
  /// From where an angle counts: a point, or + (v) for a direction.
  struct Reference {
    Vector value;
    bool is_direction = false;
    SourceLocation where;
  };
  std::string kind, name;  ///< the kind in small letters
  SourceLocation where, name_where;
  std::vector<std::size_t> links;
  std::vector<Bracket> brackets;
  std::vector<Reference> references;
  std::vector<Vector> zeros;
  SourceLocation zero_where;
  std::optional<Expression> length;
  Pose pose;
  bool actuated = false;
  ReadName driver, follower;  ///< of a joint that follows another, or a gear
  Expression ratio = 1, offset = 0;

  /// "the revolute joint 'elbow'", or "the revolute joint".
  std::string described() const;
};

/// The section [DH] being read.
struct DhDraft {
  /// What stands in a row where no constant is known: the name of its joint.
  struct Variable {
    std::string name;
    SourceLocation where;
    std::size_t column = 0;
  };
  DhConvention convention = DhConvention::standard;
  SourceLocation where;
  std::size_t base = 0;              ///< the link before the row
  std::vector<std::string> columns;  ///< "a", "alpha", "d", "theta" in the order of the text
  std::vector<Expression> cells;
  std::vector<Variable> variables;
  std::string link;  ///< of the row, where it is given
  SourceLocation row_where, link_where;
  bool reads_cells = false;
  bool has_rows = false, last_has_name = false;
};

struct OutputDraft {
  Output output;  ///< but for what names stand for
  std::string kind;
  ReadName link, frame, point, joint;
  std::optional<Vector> vector;
};

class PartBuilder : public symbolic::ModelBuilder {
 public:
  static constexpr std::size_t kMaxIncludes = 100, kMaxIncludeDepth = 10, kMaxFaces = 64;

  PartBuilder(const std::string& file_, std::optional<std::filesystem::path> folder_);

  Robot robot;
  ConstantScope scope;
  /// Begins with another reader's links, joints and constants. `ground` is the first link, where none is called so.
  void go_on_with(const Robot& begun);

  /// Parses an included text with this builder.
  std::function<void(const std::string& text)> parse_included;
  std::string_view text;  ///< the file being read

  // Names.
  std::string resolve(std::string_view name_read) const;  ///< arm::elbow, with the prefix of the file being read
  void push_constant(std::string_view name_read, const SourceLocation& where);
  void define_constant();
  std::size_t require_link(const ReadName& link, const std::string& expectation) const;

  // Points, directions, transformations.
  std::vector<ReadPoint> points;
  Vector pop_vector();
  Expression pop_value();
  void push_offset(const SourceLocation& where);
  void shift_point();
  void push_vertex(std::string_view digits, const SourceLocation& where);
  void push_named_point(const std::string& point, const SourceLocation& where);
  std::string transform_name;
  SourceLocation transform_where;
  std::size_t values_before_transform = 0;
  bool transform_is_inverse = false;
  void finish_transform();

  // Colours.
  std::array<double, 3> rgb{};
  double colour_factor = 1;
  std::string colour, link_colour, shape_colour;
  void begin_colour();
  void add_colour(const std::array<double, 3>& part);
  void finish_colour();

  // Links and shapes.
  bool in_obstacles = false, hidden = false;
  bool link_has_parts = false;  ///< or may have: a colon stands behind its name
  SourceLocation shape_where;
  std::string quoted;  ///< the name of a file
  SourceLocation quoted_where;
  void begin_link(const std::string& name_read, const SourceLocation& where);
  void finish_named_point();
  void finish_shape(Shape::Kind shape_kind, std::vector<Vector> shape_points, const Expression& radius);
  void finish_body();
  void finish_box();
  void finish_prism();
  /// A sphere, a cylinder; or a line.
  void finish_solid(Shape::Kind shape_kind);
  void finish_segments();

  // Joints.
  JointDraft draft;
  bool bracket_has_two = false;
  void begin_joint(std::string_view word, const SourceLocation& where);
  void joint_link(std::string_view name_read, const SourceLocation& where);
  void push_bracket(const SourceLocation& where);
  void push_named_reference(const std::string& point, const SourceLocation& where);
  void finish_joint();
  void finish_connector();
  void finish_gear();
  /// The joint read last, for messages; empty where there is none.
  std::string last_joint;

  // Rows of Denavit and Hartenberg.
  DhDraft dh;
  void begin_dh(std::string_view convention, const SourceLocation& where);
  void add_dh_column(std::string_view word, const SourceLocation& where);
  void begin_dh_row(const SourceLocation& where);
  void finish_dh_cells();
  void finish_dh_row();
  void finish_dh();

  // The other sections.
  OutputDraft output;
  std::size_t output_axis = 0;  ///< x, y, z; 3: the angle phi
  void add_input(std::string_view name_read, const SourceLocation& where);
  void finish_output_range(const SourceLocation& where);
  void begin_only(const SourceLocation& where);
  void finish_output();
  void include(const std::string& prefix_read);
  void add_requirement(std::string line, const SourceLocation& where);
  void read_equations();
  void pass_over(const std::string& what);

  /// After the whole text.
  void finish();

 private:
  struct Body {
    std::string file;  ///< of a body from a file
    bool is_read = true;
    std::vector<Vector> vertices;  ///< what joints may name by number
  };
  struct LinkData {
    std::vector<std::pair<std::string, Vector>> points;
    std::vector<Body> bodies;
  };
  void add_body(Body body);
  std::vector<Vector> read_points() const;
  const Vector* find_point(std::size_t link, const std::string& point) const;
  const Vector& require_point(std::size_t link, const ReadName& point) const;
  std::size_t require_joint(const ReadName& joint, const std::string& expectation) const;
  Joint named_joint();
  void set_axes(Joint& joint);
  void set_ranges(Joint& joint);
  void require_brackets(std::size_t least, std::size_t most, const std::string& expectation) const;
  void set_zero_directions();
  void leave_out_unconnected_links();
  void couple(const Joint& joint);
  void resolve_couplings();
  const Expression& dh_cell(const std::string& column) const;
  void read_dh_variable(DhRow& row, bool& slides, int& sense) const;
  void note_dh_degrees(const std::string& column, const symbolic::Expression& angle);
  void ask_for_what_dh_leaves_open();
  void resolve_outputs();

  std::optional<std::filesystem::path> folder_;
  std::string prefix_;
  std::vector<std::string> open_files_;
  std::size_t includes_ = 0;
  bool is_world_, goes_on_ = false;
  std::optional<std::size_t> link_;  ///< of the points that are read
  std::vector<LinkData> link_data_;
  std::vector<ReadName> named_inputs_;
  std::vector<std::string> dh_joints_, dh_tools_;  ///< of all rows; the last link of each section
  std::vector<OutputDraft> outputs_;
  std::vector<JointDraft> couplings_;
  std::vector<std::pair<std::string, int>> passed_over_;
};

/// In small letters.
std::string small_letters(std::string_view word);

}  // namespace corank::kinematics
