// Measures the units of a search as a cluster would run them, for bench/makespan.py. Usage:
//   corank_bench_shards MODEL SET SIGMA BOXES UNITS > units.json
// BOXES: what a worker processes of a unit before it gives the rest back; UNITS: so many the coordinator tries to have
// waiting. One thread; of the sheets' units every fourth is run, and stands for four.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <deque>

#include "corank/solve/cluster.h"
#include "corank/solve/shard_bytes.h"
#include "corank/study/model.h"
#include "corank/study/question.h"

namespace {

using namespace corank;
// Of the process, which has one thread: another's work on the machine does not count.
double now() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double since(double begun) { return now() - begun; }

// Of what is left to do in an answer: all that has to come back where the boxes found are stored elsewhere.
std::size_t left_bytes(const std::string& answer) {
  solve::Work left;
  for (solve::Received::Part& part : solve::answer_from(answer).parts)
    for (solve::Waiting& box : part.shard.left) left.boxes.push_back(std::move(box));
  return solve::to_bytes(left).size();
}

// Few units wait: what there is is cut into more of them.
std::size_t more_units(std::size_t wanted, std::size_t waiting) {
  constexpr std::size_t kMost = 64;
  return std::clamp<std::size_t>(wanted > waiting ? wanted - waiting : 0, 1, kMost);
}

int measure(const std::string& model, const std::string& set, double sigma, std::uint64_t boxes, std::size_t wanted) {
  study::Question question{.model = study::read_model(model).mechanism};
  question.set = symbolic::singularity_set_from_string(set);
  solve::Options options;
  options.sigma = sigma;
  solve::Control control;
  const solve::Prepared prepared = solve::prepare(study::system(question), options, control);
  solve::Coordinator coordinator(solve::to_bytes(prepared));
  fmt::print("{{\"line\": \"{} {} {:g}\", \"boxes\": {}, \"prepared_bytes\": {},\n \"units\": [\n", question.model.name(),
             set, sigma, boxes, coordinator.prepared_bytes().size());
  solve::UnitRunner runner(coordinator.prepared_bytes());
  struct Given {
    int number, parent;
    std::string unit;
  };
  std::deque<Given> waiting;
  int count = 0, parent = -1;
  bool first = true;
  const auto take = [&] {
    const auto begun = now();
    for (std::string& unit : coordinator.take_units(more_units(wanted, waiting.size())))
      waiting.push_back({count++, parent, std::move(unit)});
    return since(begun);
  };
  double taking = take();
  while (!waiting.empty()) {
    const Given given = std::move(waiting.front());
    waiting.pop_front();
    const bool cut = solve::unit_from(given.unit).cut;
    if (cut && given.number % 4 != 0) continue;
    const auto begun = now();
    const std::string answer = runner.run(given.unit, {.boxes = boxes});
    const double ran = since(begun);
    const auto came = now();
    double added = 0;
    if (!cut) {  // the boxes of all sheets would not fit beside one another
      coordinator.add(answer);
      added = since(came);
      parent = given.number;
      taking = take();
    } else {
      solve::answer_from(answer);
      added = since(came);
    }
    fmt::print(
        "{}  {{\"id\": {}, \"parent\": {}, \"cut\": {}, \"stands_for\": {}, \"seconds\": {:.6f}, \"client\": {:.6f}, "
        "\"sent\": {}, "
        "\"received\": {}, \"left\": {}}}",
        first ? "" : ",\n", given.number, given.parent, cut, cut ? 4 : 1, ran, added + taking, given.unit.size(),
        answer.size(), left_bytes(answer));
    taking = 0;
    first = false;
  }
  fmt::print("\n]}}\n");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) {
    fmt::print(stderr, "usage: {} MODEL SET SIGMA BOXES UNITS\n", argv[0]);
    return 2;
  }
  try {
    return measure(argv[1], argv[2], std::atof(argv[3]), std::strtoull(argv[4], nullptr, 10),
                   std::strtoull(argv[5], nullptr, 10));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
