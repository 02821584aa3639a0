// What a picture shows: the boxes of one or several results in two or three coordinates. Here it is decided which
// coordinates, colours and names there are; how it is drawn is the matter of portrait.h (.svg, .pdf, .png), vtp.cc and
// gcl.cc.
//
// A coordinate is a variable or an angle θ, whose values over a box are drawn_angle() of the box's cosine and
// sine. A box across the end of the angle's range is drawn in pieces, one at each end: every piece is the box, a turn apart.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "corank/core/interval.h"
#include "corank/report/pictures/set_look.h"
#include "corank/result/cuik/cuik_files.h"
#include "corank/result/values/result.h"

namespace corank::report {

/// Of a verdict; blue where there is none.
Color verdict_color(std::optional<Verdict> verdict);
/// On paper; of no mechanism's set grey-blue.
Color set_color(const std::string& set);

/// Boxes and the coordinates that they can be drawn in.
struct PictureSource {
  std::string file;  ///< for messages, and for the legend where the set is unknown
  std::string set;   ///< "forward" …, empty where unknown
  result::SolFile boxes;
  std::vector<Angle> angles;
  int dimension = 2;  ///< of the set, where known
  /// Of a workspace boundary: each box's passage, and where it is proven the side, in the space of these outputs.
  std::vector<Passage> passages = {};
  std::vector<std::vector<double>> sides = {};
  std::vector<std::string> outputs = {};
  /// In place of boxes.boxes, where given: somebody else's, of which no copy is made.
  const std::vector<CoverBox>* cover = nullptr;

  std::size_t count() const { return cover ? cover->size() : boxes.boxes.size(); }
  const Box& box(std::size_t k) const { return cover ? (*cover)[k].box : boxes.boxes[k].box; }
  std::optional<Verdict> verdict(std::size_t k) const { return cover ? (*cover)[k].verdict : boxes.boxes[k].verdict; }
};
/// Without a copy of the boxes: the result has to outlive it.
PictureSource picture_view(const result::Result& result, const std::string& file);
PictureSource picture_view(const result::Result&&, const std::string&) = delete;
/// A solution file says nothing about angles: c_NAME and s_NAME are taken for the cosine and sine of the angle NAME in [−π,
/// π].
PictureSource picture_source(const result::SolFile& boxes, const std::string& file);

struct PictureBox {
  /// With two axes the third side is [0, 0].
  std::array<Interval, 3> sides;
  std::optional<Verdict> verdict;
  int number = 0;  ///< of the box in its result, from 0; the pieces of a box share it
};

/// Boxes of one colour, an entry of the legend.
struct PictureLayer {
  std::string label;
  std::string set;
  Color color;
  double opacity = 1;
  std::vector<PictureBox> boxes;
};

struct PictureAxis {
  std::string name;                 ///< "J3x", "theta2"
  std::string function = {};        ///< "cos", "sin" where the variable is that of the angle `name`
  bool angle = false;               ///< in radians
  std::optional<Interval> range{};  ///< of an angle: its range, of one turn at most
};

/// A short stroke from a barrier to the side where the output cannot go.
struct PictureHatch {
  std::array<double, 2> from, direction;  ///< in the axes; a direction as long as its part in their plane
};

struct Picture {
  std::vector<PictureAxis> axes;           ///< two or three
  std::vector<PictureHatch> hatches = {};  ///< where the axes are outputs of a workspace boundary
  std::vector<PictureLayer> layers;        ///< in the order of drawing: C-space before its subsets
};

/// What the colours tell apart: sets, verdicts, or nothing (all blue).
enum class ColorScheme { set, verdict, plain };

struct PictureOptions {
  std::vector<std::string> axes;  ///< variables by name or number from 1, angles by name; two or three
  ColorScheme color = ColorScheme::set;
  double size = 0;  ///< 0: boxes as they are; else cubes with this edge about their centres
};

/// A source without boxes becomes a layer without boxes. Where colours tell sets apart, several sources of one set get
/// shades and the names of their files, and boxes that were not searched (`pending`) are a layer of their own. Throws
/// std::invalid_argument where there are not two or three axes or a source lacks one.
Picture make_picture(const std::vector<PictureSource>& sources, const PictureOptions& options);

/// True where no layer has a box.
bool is_empty(const Picture& picture);

/// certify::angle_enclosure to the last bit, in less time where the 11 bits that a long double has more than a double settle
/// how to round. That rests on the C library's atan2l being wrong by less than eight units of its last bit: good for a
/// picture, not for a proof.
Interval drawn_angle(const Interval& c, const Interval& s, const Interval& range);

/// The picture for ParaView and other programs built on VTK, as PolyData (.vtp, XML; "VTK File Formats", Kitware). A box is
/// 4 points and a face, or with three axes 8 points and 6 faces; a face is a cell. Cell data: `box`, the box's number in
/// its result, from 0; `verdict`, −1 where there is none; `set`, the number of the layer. Field data hold the names:
/// `verdict_names`, `set_names`, `axes`. Data arrays are compressed by zlib. Throws std::invalid_argument where there is no
/// box.
std::string to_vtp(const Picture& picture);

/// The picture for Geomview, in its command language, with the boxes as OFF meshes of OOGL, in the manner of the CUIK
/// suite's cuikplot3d; coordinates have 9 digits. `name`: what Geomview shows; `comment`: a line at the file's head, such
/// as the command that makes it. With two axes the picture is flat, z = 0. Throws ResultFileError where there are no boxes
/// to show.
std::string to_gcl(const Picture& picture, const std::string& name, const std::string& comment);

}  // namespace corank::report
