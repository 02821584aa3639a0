// Which searches may be put together: those of one version, whose searches come to the same boxes.
#pragma once

#include <string>

namespace corank::solve {

/// "0.1.0 (search 3f9a01c2b7d4)": corank's version and a hash of the sources that decide what a search does.
const std::string& engine_version();

}  // namespace corank::solve
