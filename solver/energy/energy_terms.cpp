#include "energy/energy_terms.h"

namespace lamella {

namespace {
constexpr bool table_is_in_order() {
  for (std::size_t i = 0; i < energy_term_table.size(); i++)
    if (std::size_t(energy_term_table[i].term) != i) return false;
  return true;
}
static_assert(table_is_in_order());
} // namespace

double EnergyTerms::sum() const {
  double sum = 0;
  for (const std::optional<double>& value : values_) sum += value.value_or(0);
  return sum;
}

double EnergyTerms::sum(Seat seat) const {
  double sum = 0;
  for (const TermInfo& term : energy_term_table)
    if (term.seat == seat) sum += value(term.term);
  return sum;
}

} // namespace lamella
