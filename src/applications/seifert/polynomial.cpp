#include "applications/seifert/polynomial.h"

#include <algorithm>

namespace unsnarl {

Polynomial without_units(Polynomial polynomial) {
  while (!polynomial.empty() && polynomial.back() == 0) polynomial.pop_back();
  const auto first = std::find_if(polynomial.begin(), polynomial.end(), [](const Integer& c) { return c != 0; });
  polynomial.erase(polynomial.begin(), first);
  if (!polynomial.empty() && polynomial.back() < 0)
    for (Integer& c : polynomial) c = -c;
  return polynomial;
}

std::string to_text(const Polynomial& polynomial) {
  std::string text;
  for (std::size_t k = 0; k < polynomial.size(); ++k) {
    const Integer& c = polynomial[k];
    if (c == 0) continue;
    const Integer size = abs(c);
    text += text.empty() ? (c < 0 ? "-" : "") : (c < 0 ? " - " : " + ");
    if (size != 1 || k == 0) text += size.str();
    if (k > 0) text += "t";
    if (k > 1) text += "^" + std::to_string(k);
  }
  return text.empty() ? "0" : text;
}

Integer value_at(const Polynomial& polynomial, int t) {
  Integer value = 0;
  for (auto c = polynomial.rbegin(); c != polynomial.rend(); ++c) value = value * t + *c;
  return value;
}

}  // namespace unsnarl
