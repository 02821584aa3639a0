#include "corank/app/set_views.h"

#include <fmt/format.h>

#include <optional>

#include "corank/app/interrupt.h"
#include "corank/app/progress.h"
#include "corank/result/verification.h"
#include "corank/study/answer.h"

namespace corank::app {

constexpr int kDigits = 12;  // of isolated points

std::optional<report::SetView> solve_view(const SetSearch& search, study::Question question, std::size_t index,
                                          std::uint64_t taken) {
  const std::vector<std::string>& sets = search.sets;
  question.set = symbolic::singularity_set_from_string(sets[index]);
  if (!symbolic::definition(question.set).has_kernel()) question.corank = 1;
  solve::Options limits;
  search.limits.apply(limits);
  solve::Control control(search.limits_beside(limits, taken));
  std::optional<solve::InStage> stage(std::in_place, control, solve::Stage::model);
  const std::vector<study::Question> parts = study::parts_of(question, [&control] { return control.ended(); });
  std::vector<System> systems;
  for (const study::Question& part : parts) {
    if (control.ended() && !systems.empty()) return std::nullopt;
    systems.push_back(study::system(part));
  }
  control.ended();  // notes the stage
  stage.reset();
  study::Options options{search.options(systems.front(), *question.set), kDigits};
  ProgressLine line(fmt::format("{} ({} of {})", sets[index], index + 1, sets.size()));
  line.follow(control);
  result::Result result = study::answer(parts, systems, options, control);
  System system = parts.front().part ? result::system_of(question.model, result) : std::move(systems.front());
  return report::set_view(std::move(result), std::move(system), question.model.has_own_velocity_equation(),
                          [&control] { return control.overdue(); });
}

}  // namespace corank::app
