// The arrows between corank's folders and who may see which library, as a function of a file's text.
#pragma once

#include <string>
#include <vector>

namespace corank::architecture {

/// What is wrong with a source file or a CMakeLists.txt, one line each: "<path>:<line>: <problem>". `path` is relative to the root
/// of the repository, "solve/solve.h".
std::vector<std::string> violations(const std::string& path, const std::string& text);

/// The same for a header that users of the installed package include: it may show nothing but the standard library and corank.
std::vector<std::string> public_header_violations(const std::string& path, const std::string& text);

/// Lines that ask the compiler for arithmetic which is not IEEE's.
std::vector<std::string> unsafe_math(const std::string& path, const std::string& text);

}  // namespace corank::architecture
