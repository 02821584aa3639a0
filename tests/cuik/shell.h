// Runs command lines in a folder of their own, with the built programs found first.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace corank::cuik {

inline std::string read_text(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

struct Outcome {
  int status = -1;
  std::string out, err;
};

/// A temporary folder that lives as long as the object.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "corank-cuik-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
    path_ = pattern;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path file(const std::string& name) const { return path_ / name; }
  void write(const std::string& name, const std::string& text) const { std::ofstream(file(name), std::ios::binary) << text; }
  std::string read(const std::string& name) const { return read_text(file(name)); }

  /// Bash runs the command there.
  Outcome run(const std::string& command) const {
    write(".command", "set -euo pipefail\nexport PATH=\"" CORANK_PROGRAMS ":$PATH\"\n" + command + "\n");
    const std::string folder = "'" + path_.string() + "'";
    const int status = std::system(("cd " + folder + " && bash .command >.out 2>.err").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 1000, read(".out"), read(".err")};
  }

 private:
  std::filesystem::path path_;
};

}  // namespace corank::cuik
