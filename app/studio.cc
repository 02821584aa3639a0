// corank studio: a page on this machine, on which a mechanism is designed while its sets are computed.
#include "corank/studio/server.h"

#include <spawn.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>

#include "corank/app/subcommands.h"

extern char** environ;

namespace corank::app {
namespace {

struct StudioCommand {
  QuestionOptions question;
  std::uint16_t port = 0;
  int threads = 0;
  bool no_browser = false;
};

/// The desktop's own program; where there is none, the address that is printed has to do.
void open_browser(const std::string& address) {
  std::string program = "xdg-open", argument = address;
  char* const words[] = {program.data(), argument.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {1, 2}) posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", 1 /* O_WRONLY */, 0);
  pid_t child = 0;
  posix_spawnp(&child, program.c_str(), &actions, nullptr, words, environ);
  posix_spawn_file_actions_destroy(&actions);
}

ExitStatus serve(const StudioCommand& command) {
  report::StudioPage page;
  const QuestionOptions& asked = command.question;
  if (!asked.file.empty()) {
    const study::ModelText text = study::read_text(asked.file);
    page.file = std::filesystem::path(asked.file).filename().string();
    page.text = text.text;
  }
  if (!asked.loops.empty()) page.loops = study::read_text(asked.loops).text;
  for (const std::string& definition : asked.definitions)
    page.constants.push_back(split_at_equals(definition, "-D", "NAME=EXPR"));
  try {
    studio::Server server({.port = command.port, .page = page, .limits = {.threads = command.threads}});
    fmt::print("{}\n", server.address());
    std::fflush(stdout);
    fmt::print(stderr, "corank: the studio is at this address, for this user only; Ctrl-C ends it\n");
    if (!command.no_browser) open_browser(server.address());
    server.run();
  } catch (const studio::ServerError& error) {
    fmt::print(stderr, "corank: the studio cannot listen on 127.0.0.1: {}\n", result::printable_line(error.what()));
    return kBadInput;
  }
  return kDone;
}

}  // namespace

void add_studio(CLI::App& program, Action& action) {
  CLI::App* sub = program.add_subcommand(
      "studio", "Show a page in the browser, on which you change a mechanism and see its singularities at once");
  const auto command = std::make_shared<StudioCommand>();
  command->question.add_model(*sub);
  command->question.add_definitions(*sub);
  add_option(*sub, "--port N", command->port, "The port on 127.0.0.1; default: any that is free");
  sub->add_flag("--no-browser", command->no_browser, "Print the address only, and open no browser");
  add_threads(*sub, command->threads);
  sub->footer(
      "The page is for this machine and this user only: its address has a random token. Nothing is written but what you\n"
      "save in the browser. Ctrl-C ends the studio and all that it runs.\n\n"
      "Exit status: 0 ended by Ctrl-C, 1 bad input, 2 wrong usage.\n\n"
      "Examples:\n  corank studio models/dextar.cuik\n  corank studio --port 8080 --no-browser");
  sub->callback([command, &action] { action = [command] { return serve(*command); }; });
}

}  // namespace corank::app
