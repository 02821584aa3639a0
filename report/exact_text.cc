#include "corank/report/exact_text.h"

#include <stdexcept>

#include "corank/certify/algebraic_number.h"

namespace corank::report {

std::optional<std::string> exact_text(const certify::ExactPoint& point, int variable) {
  const certify::RationalPolynomial& x = point.coordinates[static_cast<std::size_t>(variable)];
  if (x.empty()) return std::nullopt;
  try {
    return certify::text({point.polynomial, point.lower, point.upper}, x);
  } catch (const std::invalid_argument&) {  // no polynomial with one root in the interval
    return std::nullopt;
  } catch (const std::domain_error&) {  // numbers of too many bits
    return std::nullopt;
  }
}

}  // namespace corank::report
