// Simulates a search on N workers of one thread each, with the coordinator that corank.cluster has and by its rules
// (python/corank/cluster/engine.py). Usage:
//   corank_bench_shards MODEL SET SIGMA WORKERS [GIGABITS [LATENCY [TASK [DEARER]]]]
// Each unit is run here, one after the other, and takes as long as this process computed for it; only the workers' clock is
// simulated. The client has one link of so many Gbit/s (10), on which what is sent queues up, and likewise what is received;
// each message takes LATENCY seconds besides (0.001). Client and scheduler are one thread: it adds answers and cuts units in
// the time that this process takes for it, and does TASK seconds of dask's own work for each unit (0.002). What has come to
// the workers' side is begun by whichever worker is idle, the longest-waiting first. Efficiency: the units' own time,
// divided by workers times makespan; assembling the cover is not in it, and is said beside it. DEARER: the same tree, were
// each of its boxes so many times as much work (1).
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <queue>
#include <vector>

#include "corank/solve/distribution/cluster.h"
#include "corank/solve/store/shard_bytes.h"
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

// The same for a search that asks very often.
double seldom_now() {
  constexpr int kBetween = 32;
  static int asked = 0;
  static double last = 0;
  if (asked++ % kBetween == 0) last = now();
  return last;
}

constexpr double kUnitSeconds = 1;  // engine.py's default

struct Cluster {
  std::size_t workers = 1;
  double bandwidth = 10 * 1.25e8, latency = 1e-3, task = 2e-3, dearer = 1;
};

struct Event {
  double time;
  std::uint64_t order;
  bool answer;  // is ready at its worker; else a unit has come to the workers
  std::size_t unit;
  friend bool operator>(const Event& a, const Event& b) { return a.time != b.time ? a.time > b.time : a.order > b.order; }
};

class Simulation {
 public:
  Simulation(const solve::Prepared& prepared, const Cluster& cluster)
      : cluster_(cluster), coordinator_(solve::to_bytes(prepared)), runner_(coordinator_.prepared_bytes()) {
    for (std::size_t i = 0; i < cluster.workers; ++i) idle_.push(0.0);
  }

  void run() {
    give_out();
    while (!events_.empty() || !ready_.empty()) {
      if (!ready_.empty() && !idle_.empty() &&
          (events_.empty() || std::max(ready_.front().time, idle_.top()) <= events_.top().time)) {
        begin();
        continue;
      }
      const Event event = events_.top();
      events_.pop();
      if (event.answer) {
        add(event);
      } else {
        ready_.push(event);
      }
    }
  }

  void say(const std::string& line, double assembly) const {
    fmt::print(
        "{}: {} workers, {:g} Gbit/s, {:g} ms a message, {:g} ms a unit: {} units, {:.1f} s of work, {:.0f} MB sent, {:.0f} "
        "MB "
        "received; makespan {:.3f} s, efficiency {:.1f} %; the client's own work {:.3f} s, longest unit {:.3f} s, assembly "
        "{:.2f} "
        "s\n",
        line, cluster_.workers, cluster_.bandwidth / 1.25e8, cluster_.latency * 1e3, cluster_.task * 1e3, units_.size(),
        worked_, 1e-6 * sent_, 1e-6 * received_, client_, 100 * worked_ / (static_cast<double>(cluster_.workers) * client_),
        client_own_, longest_, assembly);
  }

  bool done() const { return coordinator_.done(); }
  double assemble() {
    solve::Control control;
    const double begun = now();
    static_cast<void>(coordinator_.assemble(control));
    return now() - begun;
  }

 private:
  struct Unit {
    std::string bytes, answer;
    double seconds = 0;  // its budget
  };

  // The client's turn: it has been busy until client_.
  void give_out() {
    const auto [most, fewest, seconds] = coordinator_.next_units(cluster_.workers, kUnitSeconds, client_);
    if (most <= under_way_) return;
    const double begun = now();
    std::vector<std::string> units = coordinator_.take_units(most - under_way_, fewest);
    work_at_client(now() - begun);
    for (std::string& unit : units) {
      work_at_client(cluster_.task);
      const auto size = static_cast<double>(unit.size() + coordinator_.prepared_bytes().size());
      sent_ += size;
      up_ = std::max(up_, client_) + size / cluster_.bandwidth;
      events_.push({up_ + cluster_.latency, order_++, false, units_.size()});
      units_.push_back({std::move(unit), {}, seconds});
      ++under_way_;
    }
  }

  void begin() {
    const Event event = ready_.front();
    ready_.pop();
    Unit& unit = units_[event.unit];
    const double begun = now();
    unit.answer = runner_.run(unit.bytes, {.seconds = unit.seconds / cluster_.dearer, .clock = seldom_now});
    const double took = cluster_.dearer * (now() - begun), start = std::max(event.time, idle_.top());
    worked_ += took;
    longest_ = std::max(longest_, took);
    idle_.pop();
    idle_.push(start + took);
    events_.push({start + took, order_++, true, event.unit});
  }

  void add(const Event& event) {
    Unit& unit = units_[event.unit];
    const auto size = static_cast<double>(unit.answer.size());
    received_ += size;
    down_ = std::max(down_, event.time) + size / cluster_.bandwidth;
    client_ = std::max(client_, down_ + cluster_.latency);
    const double begun = now();
    const auto answer = std::make_shared<const std::string>(std::move(unit.answer));
    coordinator_.add(*answer, answer);
    work_at_client(now() - begun);
    --under_way_;
    give_out();
  }

  void work_at_client(double seconds) {
    client_ += seconds;
    client_own_ += seconds;
  }

  const Cluster cluster_;
  solve::Coordinator coordinator_;
  solve::UnitRunner runner_;
  std::vector<Unit> units_;
  std::priority_queue<Event, std::vector<Event>, std::greater<>> events_;
  std::queue<Event> ready_;
  std::priority_queue<double, std::vector<double>, std::greater<>> idle_;
  std::size_t under_way_ = 0;
  std::uint64_t order_ = 0;
  double client_ = 0, up_ = 0, down_ = 0;  // when they are free next
  double worked_ = 0, longest_ = 0, client_own_ = 0, sent_ = 0, received_ = 0;
};

int simulate(const std::string& model, const std::string& set, double sigma, const Cluster& cluster) {
  study::Question question{.model = study::read_model(model).mechanism};
  question.set = symbolic::singularity_set_from_string(set);
  solve::Options options;
  options.sigma = sigma;
  solve::Control control;
  Simulation simulation(solve::prepare(study::system(question), options, control), cluster);
  simulation.run();
  if (!simulation.done()) throw std::runtime_error("the simulation came to its end before the search");
  simulation.say(fmt::format("{} {} {:g}", question.model.name(), set, sigma), simulation.assemble());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5 || argc > 9) {
    fmt::print(stderr, "usage: {} MODEL SET SIGMA WORKERS [GIGABITS [LATENCY [TASK [DEARER]]]]\n", argv[0]);
    return 2;
  }
  try {
    Cluster cluster{.workers = std::strtoull(argv[4], nullptr, 10)};
    if (argc > 5) cluster.bandwidth = 1.25e8 * std::atof(argv[5]);
    if (argc > 6) cluster.latency = std::atof(argv[6]);
    if (argc > 7) cluster.task = std::atof(argv[7]);
    if (argc > 8) cluster.dearer = std::atof(argv[8]);
    return simulate(argv[1], argv[2], std::atof(argv[3]), cluster);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
