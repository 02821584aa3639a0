#include "corank/report/pictures/picture.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <pugixml.hpp>
#include <span>
#include <sstream>
#include <stdexcept>

#include "corank/core/check.h"
#include "corank/report/pictures/box_payload.h"

namespace corank::report {
namespace {

template <class T>
std::span<const std::uint8_t> bytes_of(const std::vector<T>& data) {
  return {reinterpret_cast<const std::uint8_t*>(data.data()), data.size() * sizeof(T)};
}

// VTK's layout: the number of blocks, the size of a whole one, of the last one where it is smaller, and of each compressed;
// then the blocks.
template <class T>
std::string compressed(const std::vector<T>& data) {
  constexpr std::size_t kBlock = std::size_t{1} << 18;
  const std::span<const std::uint8_t> bytes = bytes_of(data);
  std::vector<std::uint64_t> header{(bytes.size() + kBlock - 1) / kBlock, kBlock, bytes.size() % kBlock};
  std::vector<std::uint8_t> blocks;
  for (std::size_t at = 0; at < bytes.size(); at += kBlock) {
    const std::size_t size = std::min(kBlock, bytes.size() - at);
    uLongf length = compressBound(static_cast<uLong>(size));
    const std::size_t before = blocks.size();
    blocks.resize(before + length);
    CORANK_CHECK(compress2(blocks.data() + before, &length, bytes.data() + at, static_cast<uLong>(size), 6) == Z_OK);
    header.push_back(length);
    blocks.resize(before + length);
  }
  return base64(bytes_of(header)) + base64(blocks);
}

template <class T>
void add_array(pugi::xml_node parent, const char* type, const char* name, const std::vector<T>& data, int components = 1) {
  pugi::xml_node node = parent.append_child("DataArray");
  node.append_attribute("type").set_value(type);
  node.append_attribute("Name").set_value(name);
  if (components > 1) node.append_attribute("NumberOfComponents").set_value(components);
  node.append_attribute("format").set_value("binary");
  node.text().set(compressed(data).c_str());
}

// Strings are the codes of their characters, each ended by 0.
void add_strings(pugi::xml_node parent, const char* name, const std::vector<std::string>& texts) {
  std::string codes;
  for (const std::string& text : texts) {
    for (const char c : text) fmt::format_to(std::back_inserter(codes), "{} ", static_cast<unsigned char>(c));
    codes += "0 ";
  }
  pugi::xml_node node = parent.append_child("Array");
  node.append_attribute("type").set_value("String");
  node.append_attribute("Name").set_value(name);
  node.append_attribute("NumberOfTuples").set_value(texts.size());
  node.append_attribute("format").set_value("ascii");
  node.text().set(codes.c_str());
}

struct Mesh {
  std::vector<double> points;
  std::vector<std::int64_t> connectivity, offsets;
  std::vector<std::int32_t> box;
  std::vector<std::int8_t> verdict;
  std::vector<std::int16_t> set;

  void add(const PictureBox& from, bool flat, std::size_t layer) {
    // Outward faces; the first one alone, seen from above, where the picture is flat.
    static constexpr std::array<std::array<int, 3>, 8> kCorners{
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
    static constexpr std::array<std::array<int, 4>, 6> kFaces{
        {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
    const std::int64_t first = static_cast<std::int64_t>(points.size() / 3);
    for (std::size_t i = 0; i < (flat ? 4 : 8); ++i)
      for (std::size_t j = 0; j < 3; ++j) points.push_back(kCorners[i][j] == 0 ? from.sides[j].lo() : from.sides[j].hi());
    for (std::size_t f = 0; f < (flat ? 1 : 6); ++f) {
      const bool bottom = f == 0 && !flat;  // the other way round
      for (std::size_t i = 0; i < 4; ++i) connectivity.push_back(first + kFaces[f][bottom ? 3 - i : i]);
      offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
      box.push_back(from.number);
      verdict.push_back(from.verdict ? static_cast<std::int8_t>(*from.verdict) : std::int8_t{-1});
      set.push_back(static_cast<std::int16_t>(layer));
    }
  }
};

}  // namespace

std::string to_vtp(const Picture& picture) {
  if (is_empty(picture)) throw std::invalid_argument("there are no boxes to draw");
  Mesh mesh;
  std::vector<std::string> sets, verdicts, axes;
  for (std::size_t k = 0; k < picture.layers.size(); ++k) {
    sets.push_back(picture.layers[k].label);
    for (const PictureBox& box : picture.layers[k].boxes) mesh.add(box, picture.axes.size() == 2, k);
  }
  for (int v = 0; v < kVerdicts; ++v) verdicts.emplace_back(to_string(static_cast<Verdict>(v)));
  for (const PictureAxis& axis : picture.axes)
    axes.push_back(axis.function.empty() ? axis.name : axis.function + " " + axis.name);

  pugi::xml_document document;
  pugi::xml_node root = document.append_child("VTKFile");
  for (const auto& [key, value] : {std::pair{"type", "PolyData"},
                                   {"version", "1.0"},
                                   {"byte_order", "LittleEndian"},
                                   {"header_type", "UInt64"},
                                   {"compressor", "vtkZLibDataCompressor"}})
    root.append_attribute(key).set_value(value);
  pugi::xml_node data = root.append_child("PolyData"), field = data.append_child("FieldData");
  add_strings(field, "axes", axes);
  add_strings(field, "set_names", sets);
  add_strings(field, "verdict_names", verdicts);
  pugi::xml_node piece = data.append_child("Piece");
  piece.append_attribute("NumberOfPoints").set_value(mesh.points.size() / 3);
  piece.append_attribute("NumberOfPolys").set_value(mesh.offsets.size());
  pugi::xml_node cells = piece.append_child("CellData");
  cells.append_attribute("Scalars").set_value("set");
  add_array(cells, "Int16", "set", mesh.set);
  add_array(cells, "Int8", "verdict", mesh.verdict);
  add_array(cells, "Int32", "box", mesh.box);
  add_array(piece.append_child("Points"), "Float64", "Points", mesh.points, 3);
  pugi::xml_node polys = piece.append_child("Polys");
  add_array(polys, "Int64", "connectivity", mesh.connectivity);
  add_array(polys, "Int64", "offsets", mesh.offsets);
  std::ostringstream out;
  document.save(out, " ");
  return out.str();
}

}  // namespace corank::report
