#include "corank/kinematics/urdf.h"

#include <fstream>

#include "corank/kinematics/urdf_document.h"
#include "corank/kinematics/urdf_tree.h"

namespace corank::kinematics {
namespace {

using symbolic::ModelError;

std::string read_text(const std::filesystem::path& path, const std::string& expected) {
  const SourceLocation where{path.string(), 0, 0};
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) throw ModelError(where, "there is no such file", expected);
  if (std::filesystem::is_directory(status)) throw ModelError(where, "is a directory", expected);
  std::ifstream in(path, std::ios::binary);
  if (!in) throw ModelError(where, "the file cannot be opened", expected);
  std::string text(UrdfDocument::kMaxBytes + 1, '\0');  // one byte more than may be: the parser refuses it
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) throw ModelError(where, "the file cannot be read", expected);
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

}  // namespace

Robot parse_urdf(std::string_view text, const std::string& file, const std::optional<UrdfLoops>& loops) {
  return read_urdf_tree(UrdfDocument(text, file), file, loops.has_value());
}

Robot read_urdf(const std::filesystem::path& urdf, const std::optional<std::filesystem::path>& loops) {
  const std::string text = read_text(urdf, "a URDF file");
  if (!loops) return parse_urdf(text, urdf.string());
  return parse_urdf(text, urdf.string(), UrdfLoops{read_text(*loops, "a .loops file"), loops->string()});
}

}  // namespace corank::kinematics
