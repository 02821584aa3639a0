#include "corank/app/json_option.h"

#include <fmt/format.h>

#include "corank/app/box_files.h"
#include "corank/app/exit_status.h"
#include "corank/result/result_file.h"

namespace corank::app {

void JsonOption::add(CLI::App& sub, const std::string& what, const std::string& table) {
  option_ = sub.add_option_function<std::vector<std::string>>(
                   "--json", [this](const std::vector<std::string>& words) { path_ = words.empty() ? "" : words.front(); },
                   fmt::format("Write {} as JSON to PATH or, without PATH, to standard output instead of {}", what, table))
                ->type_name("[PATH]")
                ->expected(0, 1);
}

void JsonOption::give_back(std::string& input, const std::string& name) {
  if (input.empty() && path_ && !path_->empty()) input.swap(*path_);
  if (input.empty()) throw UsageError(name + " is required; corank --help tells more");
}

void JsonOption::check() const {
  if (given()) check_output(path());
}

bool JsonOption::say(const std::function<std::string()>& text) const {
  if (takes_standard_output())
    fmt::print("{}\n", text());
  else if (given())
    result::write_text(path(), text() + "\n");
  return !takes_standard_output();
}

}  // namespace corank::app
