// Can the robot be assembled within its ranges at all? What a result proves of that, which an empty set alone does not say.
#pragma once

#include <optional>
#include <string>

#include "corank/result/result.h"

namespace corank::result {

/// true: a configuration is proven to exist. false: it is proven that there is none. Nothing: neither is known, or the
/// result is of a plain system.
std::optional<bool> assembled(const Result& result);

/// A configuration that is proven to exist: in the box, in the first `configuration_size` variables of `of`.
struct Sample {
  const Result* of = nullptr;  ///< the result, or its assembly
  const CoverBox* box = nullptr;
};
/// Nothing where assembled() is not true.
std::optional<Sample> sample(const Result& result);

/// What an empty set leaves open, in sentences: whether the robot can be assembled, with the sample; and what helps where
/// rounded decimals contradict each other. Empty for a set with boxes.
std::vector<std::string> assembly_sentences(const Result& result);

}  // namespace corank::result
