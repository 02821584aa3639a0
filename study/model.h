// A model from any file that says what a mechanism is: equations (.cuik), parts (.world, or .cuik with [LINKS]) or URDF.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "corank/kinematics/equations/assembly.h"
#include "corank/result/values/result.h"

namespace corank::study {

struct Model {
  symbolic::Mechanism mechanism;
  std::optional<kinematics::Assembly> assembly;  ///< of a robot from parts; its mechanism is the same
  std::vector<std::string> notices;              ///< what of a robot's file was passed over, and what is special about it
};

/// A text, and the name that messages show, whose extension says in which language the text is.
struct ModelText {
  std::string text, file;
  std::optional<std::filesystem::path> folder{};  ///< where other files that it names are looked for; nothing: nowhere
};

/// The model of a text, with these constants put in; of URDF with the text of its companion. Throws symbolic::ModelError.
Model parse_model(const ModelText& model, const std::vector<result::ConstantOverride>& constants = {},
                  const std::optional<ModelText>& loops = {});
/// The text of a file.
ModelText read_text(const std::filesystem::path& path);

/// Reads a file, with these constants put in. A robot's equations depend on them (parallel axes make it a planar one): so
/// its text, which results keep, is that of a model file with the equations that belong to these values. `loops`: the
/// companion of a URDF file. Throws symbolic::ModelError.
Model read_model(const std::filesystem::path& path, const std::vector<result::ConstantOverride>& constants = {},
                 const std::optional<std::filesystem::path>& loops = {});

/// Adds requirements (symbolic/model/requirement_text.h), also to the model's text, which results keep.
void require(const std::vector<std::string>& texts, Model& model);

/// "planar, mobility 1 …": what the parts make, in one line.
std::string describe(const kinematics::Assembly& assembly);

}  // namespace corank::study
