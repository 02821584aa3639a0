// corank derive: the equations, for people (text, latex) and for programs (cuik); the model itself (model).
#include <fmt/format.h>

#include <memory>

#include "corank/app/question.h"
#include "corank/app/subcommands.h"
#include "corank/result/printable.h"
#include "corank/study/model.h"
#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/model_text.h"
#include "corank/symbolic/printer.h"

namespace corank::app {
namespace {

ExitStatus derive(QuestionOptions options, const std::string& format) {
  study::Question question = load(options);
  if (question.assembly) fmt::print("{}{}\n", format == "text" ? "Robot: " : "% ", study::describe(*question.assembly));
  if (question.assembly && question.model.constraints().empty()) {
    fmt::print("It has no loops and no outputs: every value of its joints is a configuration.\n");
    return kDone;
  }
  if (format == "model") {
    fmt::print("{}", result::printable(symbolic::to_model(question.model)));
    return kDone;
  }
  if (options.set.empty() && !question.model.is_plain_system()) options.set = "cspace";
  question.set = chosen_set(options, question.model);
  const symbolic::TrigonometricSystem system = study::equations(question);
  if (!system.claimed.empty()) static_cast<void>(study::system(question, system));  // refuses what does not follow
  if (format == "cuik") {
    fmt::print("{}", result::printable(symbolic::to_cuik(symbolic::algebrize(system))));
  } else {
    const symbolic::Derivation derivation = symbolic::derive(question.model);
    fmt::print("{}", result::printable(format == "latex" ? symbolic::to_latex(derivation, system)
                                                         : symbolic::to_text(derivation, system)));
  }
  return kDone;
}

}  // namespace

void add_derive(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("derive", "Print the constraints, their Jacobian blocks and a system");
  const auto question = std::make_shared<QuestionOptions>();
  const auto format = std::make_shared<std::string>("text");
  question->add_options(*command);
  command
      ->add_option("--format", *format,
                   "text or latex: with sines and cosines; cuik: polynomials, a file that corank solve accepts;\n"
                   "model: the model itself in order, whatever --set")
      ->check(CLI::IsMember({"text", "latex", "cuik", "model"}))
      ->capture_default_str();
  command->footer(
      "The set is cspace where --set is not given.\n\n"
      "Example:\n  corank derive models/dextar.cuik --set inverse --format latex");
  command->callback([=, &action] { action = [=] { return derive(*question, *format); }; });
}

}  // namespace corank::app
