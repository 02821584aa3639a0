#include "corank/analyze/paths/path_graph.h"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/graph/filtered_graph.hpp>
#include <map>
#include <random>
#include <set>

#include "corank/core/box_tree.h"
#include "corank/core/rounding.h"
#include "corank/solve/search/solve.h"

namespace corank::analyze {
namespace {

constexpr double kGap = 1e-9;

using BoostGraph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property,
                                         boost::property<boost::edge_weight_t, double>>;
using Edge = boost::graph_traits<BoostGraph>::edge_descriptor;

bool may_have(const std::vector<int>& box, const std::vector<int>& signs) {
  for (std::size_t k = 0; k < signs.size(); ++k)
    if (box[k] != 0 && box[k] != signs[k]) return false;
  return true;
}

// With room for rounding.
Box widened(Box box, const std::vector<double>& sizes) {
  const UpwardRounding rounding;
  for (std::size_t j = 0; j < box.size(); ++j) box[j] += Interval(-kGap, kGap) * Interval(sizes[j]);
  return box;
}

Box about(const PathSpace& space, const PathSpace::Point& x) {
  Box box;
  for (const double value : space.values(x)) box.emplace_back(value);
  return widened(std::move(box), space.sizes());
}

}  // namespace

struct PathGraph::Graph {
  Cover cover;
  std::vector<std::vector<int>> signs;  // of each box
  std::unique_ptr<BoxTree> tree;
  std::vector<std::vector<std::size_t>> neighbours;  // with a larger index
  // Of each sign vector asked for: a point of each box that has these signs, with its margin; 0 where there is none.
  struct Points {
    std::vector<PathSpace::Point> at;
    std::vector<double> margin;
    BoostGraph graph;
  };
  std::map<std::vector<int>, Points> points;
  struct Groups {
    std::vector<std::size_t> boxes, group;
    std::map<std::size_t, std::size_t> group_of;  // box
  };
  mutable std::map<std::vector<int>, Groups> groups;
};

PathGraph::~PathGraph() = default;

PathGraph::PathGraph(const PathSpace& space, double sigma, int threads, std::uint64_t most_boxes, solve::Control& control)
    : space_(space), sigma_(sigma), graph_(std::make_unique<Graph>()) {
  double length = 1;
  for (std::size_t j = 0; j < space.sizes().size(); ++j)
    if (space.system().variables[j].is_plain_length()) length = space.sizes()[j];
  const solve::Options options{
      .sigma_length = sigma * length, .sigma_angle = sigma, .threads = threads, .max_found = most_boxes};
  graph_->cover = solve::solve(solve::prepare(space.system(), options, control), control);
  Cover& cover = graph_->cover;
  if (most_boxes > 0 && cover.boxes.size() >= most_boxes) return;
  ready_ = cover.complete();
  if (!ready_ || cover.boxes.empty()) return;
  const UpwardRounding rounding;
  for (const CoverBox& box : cover.boxes) graph_->signs.push_back(space.signs(box.box));
  graph_->tree = std::make_unique<BoxTree>(box_tree(cover.boxes, &CoverBox::box));
  graph_->neighbours.resize(cover.boxes.size());
  for (std::size_t b = 0; b < cover.boxes.size(); ++b)
    graph_->tree->for_each_overlapping(widened(cover.boxes[b].box, space.sizes()), 0, [&](std::size_t other) {
      if (other > b) graph_->neighbours[b].push_back(other);
    });
}

std::vector<std::size_t> PathGraph::compatible(const std::vector<int>& signs) const {
  std::vector<std::size_t> result;
  for (std::size_t b = 0; b < graph_->signs.size(); ++b)
    if (may_have(graph_->signs[b], signs)) result.push_back(b);
  return result;
}

bool PathGraph::apart(const Box& from, const Box& to, const std::vector<int>& signs) const {
  if (!ready_ || !graph_->tree) return false;
  auto [entry, is_new] = graph_->groups.try_emplace(signs);
  Graph::Groups& groups = entry->second;
  if (is_new) {
    groups.boxes = compatible(signs);
    const auto box_of = [&](std::size_t b) -> const Box& { return graph_->cover.boxes[b].box; };
    groups.group = box_tree(groups.boxes, box_of).groups(0.0, {});
    for (std::size_t k = 0; k < groups.boxes.size(); ++k) groups.group_of[groups.boxes[k]] = groups.group[k];
  }
  const auto groups_of = [&](const Box& end) {
    std::set<std::size_t> found;
    graph_->tree->for_each_overlapping(end, 0.0, [&](std::size_t b) {
      if (const auto g = groups.group_of.find(b); g != groups.group_of.end()) found.insert(g->second);
    });
    return found;
  };
  const std::set<std::size_t> a = groups_of(from), b = groups_of(to);
  return std::ranges::none_of(a, [&](std::size_t g) { return b.contains(g); });
}

void PathGraph::prepare_points(const std::vector<int>& signs) {
  auto [entry, is_new] = graph_->points.try_emplace(signs);
  if (!is_new) return;
  constexpr int kTries = 6;
  Graph::Points& points = entry->second;
  const std::size_t count = graph_->cover.boxes.size();
  points.at.resize(count);
  points.margin.assign(count, 0);
  std::mt19937_64 random(20250401);
  for (const std::size_t b : compatible(signs)) {
    const Box& box = graph_->cover.boxes[b].box;
    for (int k = 0; k < kTries && points.margin[b] == 0; ++k) {
      PathSpace::Point x(space_.size());
      for (int j = 0; j < space_.size(); ++j) {
        const Interval& side = box[j];
        const double share = k == 0 ? 0.5 : std::uniform_real_distribution<double>(0, 1)(random);
        x(j) = (side.lo() + share * (side.hi() - side.lo())) / space_.sizes()[j];
      }
      if (!space_.project(x, sigma_ + 1e-6 + 0.5 * x.lpNorm<Eigen::Infinity>())) continue;
      const PathSpace::State state = space_.state(x);
      if (state.signs != signs || !state.inside) continue;
      points.at[b] = x;
      points.margin[b] = state.margin;
    }
  }
  points.graph = BoostGraph(count);
  for (std::size_t b = 0; b < count; ++b)
    for (const std::size_t c : graph_->neighbours[b]) {
      if (points.margin[b] == 0 || points.margin[c] == 0) continue;
      // Narrow places cost up to ten times their length.
      const double narrow = 1 + 0.1 / (std::min(points.margin[b], points.margin[c]) + 0.01);
      boost::add_edge(b, c, (points.at[b] - points.at[c]).norm() * narrow, points.graph);
    }
}

void PathGraph::block(std::size_t step, Blocked& blocked) const {
  if (step == 0 || step >= last_way_.size() + 1) return;  // the ends' own
  const std::size_t a = last_way_[step - 1], b = last_way_[std::min(step, last_way_.size() - 1)];
  blocked.emplace_back(std::min(a, b), std::max(a, b));
}

std::optional<TubeBuilder::Points> PathGraph::way(const PathSpace::Point& from, const PathSpace::Point& to,
                                                  const std::vector<int>& signs, const TubeBuilder& builder,
                                                  Blocked& blocked, const solve::Control& control) {
  constexpr int kTries = 60;
  if (!ready_ || !graph_->tree) return std::nullopt;
  prepare_points(signs);
  Graph::Points& points = graph_->points.at(signs);
  const double step = 0.25 * sigma_;
  const auto accept = [&](const PathSpace::Point& x) { return space_.admits(x, signs); };
  const auto near = [&](const PathSpace::Point& end) {
    std::vector<std::size_t> found;
    graph_->tree->for_each_overlapping(about(space_, end), 0, [&](std::size_t b) {
      if (points.margin[b] > 0 && builder.follow(end, points.at[b], step, accept)) found.push_back(b);
    });
    return found;
  };
  const std::vector<std::size_t> starts = near(from), goals = near(to);
  if (starts.empty() || goals.empty()) return std::nullopt;
  std::set<std::pair<std::size_t, std::size_t>> closed(blocked.begin(), blocked.end()), open;
  for (int k = 0; k < kTries && !control.ended(); ++k) {
    const auto passable = [&](const Edge& e) {
      const std::size_t a = boost::source(e, points.graph), b = boost::target(e, points.graph);
      return !closed.contains({std::min(a, b), std::max(a, b)});
    };
    const boost::filtered_graph<BoostGraph, std::function<bool(Edge)>> graph(points.graph, passable);
    std::vector<std::size_t> before(points.at.size());
    std::vector<double> distance(points.at.size());
    boost::dijkstra_shortest_paths(
        graph, starts.front(),
        boost::predecessor_map(boost::make_iterator_property_map(before.begin(), boost::get(boost::vertex_index, graph)))
            .distance_map(boost::make_iterator_property_map(distance.begin(), boost::get(boost::vertex_index, graph))));
    const std::size_t goal =
        *std::ranges::min_element(goals, [&](std::size_t a, std::size_t b) { return distance[a] < distance[b]; });
    if (goal != starts.front() && before[goal] == goal) return std::nullopt;
    last_way_.assign(1, goal);
    while (last_way_.back() != starts.front()) last_way_.push_back(before[last_way_.back()]);
    std::ranges::reverse(last_way_);
    bool whole = true;
    for (std::size_t v = 0; v + 1 < last_way_.size(); ++v) {
      const auto pair = std::minmax(last_way_[v], last_way_[v + 1]);
      if (open.contains(pair)) continue;
      if (builder.follow(points.at[pair.first], points.at[pair.second], step, accept)) {
        open.insert(pair);
      } else {
        closed.insert(pair);
        blocked.push_back(pair);
        whole = false;
      }
    }
    if (!whole) continue;
    TubeBuilder::Points result{from};
    for (const std::size_t b : last_way_) result.push_back(points.at[b]);
    result.push_back(to);
    return result;
  }
  return std::nullopt;
}

}  // namespace corank::analyze
