#include "energy/energy_terms.h"

#include <algorithm>

namespace lamella {

namespace {
constexpr bool table_is_in_order() {
  for (std::size_t i = 0; i < energy_term_table.size(); i++)
    if (std::size_t(energy_term_table[i].term) != i) return false;
  return true;
}
static_assert(table_is_in_order());
} // namespace

bool is_term_name(std::string_view word) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !word.empty() && is_letter(word[0]) && std::ranges::all_of(word, [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '_';
  });
}

void EnergyTerms::add(const TermName& term, double energy) {
  if (const Term* built_in = std::get_if<Term>(&term)) {
    std::optional<double>& sum = (*this)[*built_in];
    sum = sum.value_or(0) + energy;
  } else {
    others_[std::get<std::string>(term)] += energy;
  }
}

double EnergyTerms::sum() const {
  double sum = 0;
  for (const std::optional<double>& value : values_) sum += value.value_or(0);
  for (const auto& [name, energy] : others_) sum += energy;
  return sum;
}

double EnergyTerms::sum(Seat seat) const {
  double sum = 0;
  for (const TermInfo& term : energy_term_table)
    if (term.seat == seat) sum += value(term.term);
  if (seat == Seat::membrane)
    for (const auto& [name, energy] : others_) sum += energy;
  return sum;
}

} // namespace lamella
