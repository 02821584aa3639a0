#include "corank/check/solution.h"

#include <algorithm>
#include <cmath>

#include "corank/check/krawczyk.h"

namespace corank::check {

Sides solution_near(const Problem& problem, const std::vector<double>& point, const std::vector<int>& held_variables,
                    std::string& fault) {
  constexpr int kInflations = 12, kSteps = 3;
  const std::size_t n = problem.system().variables.size();
  const auto no = [&](const char* why) {
    fault = why;
    return Sides();
  };
  if (point.size() != n || !std::all_of(point.begin(), point.end(), [](double x) { return std::isfinite(x); }))
    return no("its point does not have one number for each variable");
  std::vector<unsigned char> held(n, 0);
  for (const int j : held_variables) {
    if (j < 0 || j >= static_cast<int>(n) || held[static_cast<std::size_t>(j)])
      return no("it holds a variable that does not exist, or one twice");
    held[static_cast<std::size_t>(j)] = 1;
  }
  std::vector<int> dependent;
  Sides x;
  for (std::size_t j = 0; j < n; ++j) {
    const double c = point[j], radius = held[j] ? 0 : 1e-10 * std::max(1.0, std::fabs(c));
    x.emplace_back(c - radius, c + radius);
    if (!held[j]) dependent.push_back(static_cast<int>(j));
  }
  Krawczyk newton(problem.equations(), static_cast<int>(n));
  if (dependent.size() != problem.equations().size())
    return no("the number of variables that it holds is not the dimension of the set");
  bool exists = false;
  for (int step = 0; !exists && step < kInflations; ++step) {
    problem.stop().poll();
    if (!newton.set(dependent, x, Krawczyk::Center::polished)) return no("its equations are singular");
    const Sides image = newton.image(x);
    exists = true;
    for (std::size_t a = 0; a < image.size(); ++a)
      exists = exists && image[a].strictly_inside(x[static_cast<std::size_t>(dependent[a])]);
    for (std::size_t a = 0; a < image.size(); ++a) {
      if (!image[a].is_bounded()) return no("no solution is shown near its point");
      Enclosure& side = x[static_cast<std::size_t>(dependent[a])];
      const double margin = 0.2 * image[a].width() + 1e-15 * image[a].mag() + 1e-300;
      if (!exists) side = Enclosure(image[a].lo() - margin, image[a].hi() + margin);
      if (exists) side = image[a];
    }
  }
  if (!exists) return no("no solution is shown near its point");
  for (int step = 0; step < kSteps; ++step) {
    if (!newton.set(dependent, x, Krawczyk::Center::refined)) break;
    const Sides image = newton.image(x);
    for (std::size_t a = 0; a < image.size(); ++a)
      if (!x[static_cast<std::size_t>(dependent[a])].intersect(image[a])) return no("no solution is shown near its point");
  }
  return x;
}

}  // namespace corank::check
