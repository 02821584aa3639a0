// The arrows between corank's folders and who may see which library, as a function of a file's text.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace corank::architecture {

/// The folders of cmake/folders.txt, and each with what it may use. Throw std::runtime_error where the list has a cycle.
std::vector<std::string> folders();
std::set<std::pair<std::string, std::string>> arrows();

/// Of the repository's folders, those whose headers the text includes.
std::set<std::string> included_folders(const std::string& text);

/// What is wrong with a source file or a CMakeLists.txt, one line each: "<path>:<line>: <problem>". `path` is relative to
/// the root of the repository, "solve/search/solve.h".
std::vector<std::string> violations(const std::string& path, const std::string& text);

/// The same for a header that users of the installed package include: it may show nothing but the standard library and
/// corank.
std::vector<std::string> public_header_violations(const std::string& path, const std::string& text);

/// Lines that ask the compiler for arithmetic which is not IEEE's.
std::vector<std::string> unsafe_math(const std::string& path, const std::string& text);

}  // namespace corank::architecture
