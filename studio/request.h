// What a page of the studio asks for, as a plain value: a model's text, values of its constants, and the sets to be seen.
//
//   {"number": 7, "want": "picture", "file": "dextar.cuik", "text": "[CONSTANTS] …", "constants": {"l2": "0.9"},
//    "sets": ["forward", "cspace"]}
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "corank/study/model.h"

namespace corank::studio {

/// No request that makes sense. what() is one line.
class RequestError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Request {
  enum class Want {
    picture,  ///< the sets, first coarse, then finer
    report    ///< the page that corank report writes
  };

  enum class Colours {
    none,
    aspects,      ///< by aspects
    requirements  ///< by whether the requirements are met
  };

  std::uint64_t number = 0;  ///< every line of the answer has it
  Want want = Want::picture;
  study::ModelText model;                           ///< without a folder: it names no other files
  std::optional<study::ModelText> loops{};          ///< the companion of a URDF file
  std::vector<result::ConstantOverride> constants;  ///< as -D gives them
  std::vector<std::string> sets;                    ///< names of sets of a mechanism, each once
  bool fine = true;                                 ///< finer boxes after the coarse ones
  Colours colours = Colours::none;                  ///< of C-space, after the finest picture
  std::vector<std::string> require{};               ///< as --require gives them
  std::string command{};                            ///< shown in a report: the command line that makes it
};

/// Throws RequestError where the text is no such JSON, or a part of it is missing, too long, or of another kind.
Request parse_request(std::string_view json);

}  // namespace corank::studio
