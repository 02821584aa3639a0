// Help texts at 100 columns, whatever the length of a description: options and subcommands in two columns, prose in
// paragraphs. Lines that begin with a space, such as examples, stay as they are.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace corank::app {

class HelpFormat : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_subcommand(const CLI::App* sub) const override;
  std::string make_description(const CLI::App* app) const override;
  std::string make_footer(const CLI::App* app) const override;
};

}  // namespace corank::app
