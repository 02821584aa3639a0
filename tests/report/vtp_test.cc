// Pictures for ParaView, read back as VTK's own reader does.
#include "corank/report/pictures/picture.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>
#include <pugixml.hpp>

namespace corank::report {
namespace {

std::string from_base64(const std::string& text) {
  static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(kDigits.find(c));
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 0xff);
  }
  return bytes;
}

template <class T>
std::vector<T> numbers(const std::string& bytes) {
  std::vector<T> data(bytes.size() / sizeof(T));
  std::memcpy(data.data(), bytes.data(), data.size() * sizeof(T));
  return data;
}

// Header and blocks are encoded one by one: 3 + blocks words of 8 bytes, then all blocks.
template <class T>
std::vector<T> array(const pugi::xml_node& parent, const char* name) {
  const pugi::xml_node node = parent.find_child_by_attribute("DataArray", "Name", name);
  EXPECT_STREQ(node.attribute("format").value(), "binary") << name;
  const std::string text = node.text().get();
  const std::uint64_t blocks = numbers<std::uint64_t>(from_base64(text.substr(0, 12))).at(0);
  const std::size_t header_bytes = 8 * (3 + blocks), header_text = (header_bytes + 2) / 3 * 4;
  const auto header = numbers<std::uint64_t>(from_base64(text.substr(0, header_text)).substr(0, header_bytes));
  const std::string data = from_base64(text.substr(header_text));
  std::string bytes;
  std::size_t at = 0;
  for (std::uint64_t k = 0; k < blocks; ++k) {
    uLongf size = k + 1 == blocks && header[2] != 0 ? header[2] : header[1];
    std::string block(size, '\0');
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(block.data()), &size, reinterpret_cast<const Bytef*>(data.data() + at),
                         header[3 + k]),
              Z_OK);
    at += header[3 + k];
    bytes += block;
  }
  EXPECT_EQ(at, data.size());
  return numbers<T>(bytes);
}

std::vector<std::string> strings(const pugi::xml_node& field, const char* name) {
  std::vector<std::string> texts(1);
  std::istringstream codes(field.find_child_by_attribute("Array", "Name", name).text().get());
  for (int code = 0; codes >> code;) code == 0 ? texts.emplace_back() : texts.back() += static_cast<char>(code);
  texts.pop_back();
  return texts;
}

PictureSource random_boxes(int count, const std::string& set) {
  PictureSource source{"a.h5", set, {}, {}, 2};
  source.boxes.variables = {"x", "y", "z"};
  for (int k = 0; k < count; ++k) {
    const double t = 0.37 * k;
    source.boxes.boxes.push_back({{{t, t + 1e-9}, {-1 / (t + 1), 2}, {0.1, 0.1}}, static_cast<Verdict>(k % 7), {}});
  }
  return source;
}

TEST(Vtp, HoldsEveryBoxWithItsVerdictItsSetAndItsNumber) {
  for (const bool flat : {true, false}) {
    const Picture picture = make_picture(
        {random_boxes(3000, "forward"), random_boxes(5, "inverse")},
        {flat ? std::vector<std::string>{"x", "y"} : std::vector<std::string>{"x", "y", "z"}, ColorScheme::set, 0});
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(to_vtp(picture).c_str()));
    const pugi::xml_node data = document.child("VTKFile").child("PolyData"), piece = data.child("Piece");
    const std::size_t corners = flat ? 4 : 8, faces = flat ? 1 : 6;
    EXPECT_EQ(piece.attribute("NumberOfPoints").as_uint(), 3005 * corners);
    EXPECT_EQ(piece.attribute("NumberOfPolys").as_uint(), 3005 * faces);
    const auto points = array<double>(piece.child("Points"), "Points");
    const auto connectivity = array<std::int64_t>(piece.child("Polys"), "connectivity");
    const auto offsets = array<std::int64_t>(piece.child("Polys"), "offsets");
    const auto box = array<std::int32_t>(piece.child("CellData"), "box");
    const auto verdict = array<std::int8_t>(piece.child("CellData"), "verdict");
    const auto set = array<std::int16_t>(piece.child("CellData"), "set");
    ASSERT_EQ(points.size(), 3 * 3005 * corners);
    ASSERT_EQ(offsets.size(), 3005 * faces);
    ASSERT_EQ(connectivity.size(), 4 * offsets.size());
    std::size_t cell = 0;
    for (std::size_t layer = 0; layer < picture.layers.size(); ++layer)
      for (const PictureBox& b : picture.layers[layer].boxes) {
        std::array<Interval, 3> hull;
        for (std::size_t f = 0; f < faces; ++f, ++cell) {
          ASSERT_EQ(box[cell], b.number);
          ASSERT_EQ(verdict[cell], static_cast<int>(*b.verdict));
          ASSERT_EQ(set[cell], static_cast<int>(layer));
          ASSERT_EQ(offsets[cell], static_cast<std::int64_t>(4 * (cell + 1)));
          for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
              const double at = points[3 * static_cast<std::size_t>(connectivity[4 * cell + i]) + j];
              ASSERT_TRUE(at == b.sides[j].lo() || at == b.sides[j].hi());
              hull[j] = f == 0 && i == 0 ? Interval(at) : Interval::hull(hull[j], at);
            }
        }
        ASSERT_EQ(hull, b.sides) << "the faces reach every side";
      }
    const auto names = strings(data.child("FieldData"), "set_names");
    EXPECT_EQ(names.at(static_cast<std::size_t>(set[0])), "forward locus");
    EXPECT_EQ(strings(data.child("FieldData"), "verdict_names").at(3), "boundary");
    EXPECT_EQ(strings(data.child("FieldData"), "axes").at(1), "y");
  }
}

TEST(Vtp, FacesOfABoxPointOutward) {
  const Picture picture = make_picture({random_boxes(1, "forward")}, {{"y", "y", "y"}, ColorScheme::set, 0});  // [−1, 2]³
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(to_vtp(picture).c_str()));
  const pugi::xml_node piece = document.child("VTKFile").child("PolyData").child("Piece");
  const auto points = array<double>(piece.child("Points"), "Points");
  const auto connectivity = array<std::int64_t>(piece.child("Polys"), "connectivity");
  double volume = 0;  // by the divergence theorem, a tetrahedron to each triangle
  for (std::size_t f = 0; f < 6; ++f)
    for (const auto& [i, j, k] : {std::array{0, 1, 2}, {0, 2, 3}}) {
      const auto at = [&](int corner, std::size_t axis) {
        return points[3 * static_cast<std::size_t>(connectivity[4 * f + static_cast<std::size_t>(corner)]) + axis];
      };
      const auto cross = [&](std::size_t a, std::size_t b) { return at(j, a) * at(k, b) - at(j, b) * at(k, a); };
      volume += (at(i, 0) * cross(1, 2) + at(i, 1) * cross(2, 0) + at(i, 2) * cross(0, 1)) / 6;
    }
  EXPECT_NEAR(volume, 27, 1e-12);
}

TEST(Vtp, RefusesToDrawNothing) { EXPECT_THROW(to_vtp(Picture{}), std::invalid_argument); }

}  // namespace
}  // namespace corank::report
