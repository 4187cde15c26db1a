#pragma once
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace lamella {

/// Where the energy of a term lives.
enum class Seat { membrane, boundary, vesicle };

/// The terms that an energy can have. What is told of each is in energy_term_table.
enum class Term {
  bending,
  gaussian,
  linear,
  cubic,
  mixed_cubic,
  quartic,
  mixed_quartic,
  gaussian_square,
  gradient,
  density,
  line_tension,
  geodesic,
  normal,
  torsion,
  geodesic_square,
  normal_square,
  torsion_square,
  line_density,
  stretch,
  pressure,
  area_difference,
  film,
  count
};

/// What a term is called: one of those that are built in, or another by a word of its own.
using TermName = std::variant<Term, std::string>;

/// Whether a term that is not built in may be called this: letters, digits and _, a letter first.
bool is_term_name(std::string_view word);

/// What is told of a term that is built in, wherever it is told.
struct TermInfo {
  Term term;
  Seat seat;
  const char* column; ///< of history.csv
  const char* label;  ///< in legends and summaries: "line tension"
  const char* symbol; ///< of the invariant, as pictures write it, or empty
  const char* phrase; ///< completes "most of it is ..."
};

/// All that are built in, in the order of Term: the one place that a new one is told in.
inline constexpr std::array<TermInfo, std::size_t(Term::count)> energy_term_table{{
    {Term::bending, Seat::membrane, "bending_energy", "bending", "", "bending"},
    {Term::gaussian, Seat::membrane, "gaussian_energy", "Gaussian curvature", "",
     "Gaussian curvature"},
    {Term::linear, Seat::membrane, "linear_energy", "mean curvature", "*K*_{M}", "mean curvature"},
    {Term::cubic, Seat::membrane, "cubic_energy", "cubic", "*K*_{M}³", "the cubic modulus"},
    {Term::mixed_cubic, Seat::membrane, "mixed_cubic_energy", "mixed cubic", "*K*_{M} *K*",
     "the mixed cubic modulus"},
    {Term::quartic, Seat::membrane, "quartic_energy", "quartic", "*K*_{M}⁴", "the quartic modulus"},
    {Term::mixed_quartic, Seat::membrane, "mixed_quartic_energy", "mixed quartic", "*K*_{M}² *K*",
     "the mixed quartic modulus"},
    {Term::gaussian_square, Seat::membrane, "gaussian_square_energy", "Gaussian square", "*K*²",
     "the square of the Gaussian curvature"},
    {Term::gradient, Seat::membrane, "gradient_energy", "gradient", "|∇*K*_{M}|²",
     "the gradient of the mean curvature"},
    {Term::density, Seat::membrane, "density_energy", "density", "", "the density given as text"},
    {Term::line_tension, Seat::boundary, "line_tension_energy", "line tension", "",
     "the length of the phase boundary"},
    {Term::geodesic, Seat::boundary, "kg_energy", "line", "*k*_{g}",
     "the geodesic curvature of the phase boundary"},
    {Term::normal, Seat::boundary, "kn_energy", "line", "*k*_{n}",
     "the normal curvature of the phase boundary"},
    {Term::torsion, Seat::boundary, "tau_g_energy", "line", "*τ*_{g}",
     "the geodesic torsion of the phase boundary"},
    {Term::geodesic_square, Seat::boundary, "kg2_energy", "line", "*k*_{g}²",
     "the squared geodesic curvature of the phase boundary"},
    {Term::normal_square, Seat::boundary, "kn2_energy", "line", "*k*_{n}²",
     "the squared normal curvature of the phase boundary"},
    {Term::torsion_square, Seat::boundary, "tau_g2_energy", "line", "*τ*_{g}²",
     "the squared geodesic torsion of the phase boundary"},
    {Term::line_density, Seat::boundary, "line_density_energy", "line density", "",
     "the line density given as text"},
    {Term::stretch, Seat::membrane, "stretch_energy", "stretch", "", "stretch"},
    {Term::pressure, Seat::vesicle, "pressure_energy", "pressure", "", "pressure"},
    {Term::area_difference, Seat::vesicle, "area_difference_energy", "area difference", "",
     "the area difference"},
    {Term::film, Seat::vesicle, "film_energy", "films", "", "the disjoining pressure of films"},
}};

constexpr const TermInfo& info(Term term) { return energy_term_table[std::size_t(term)]; }

/// Values of terms; those that a scene does not have are empty. Every scene has bending.
class EnergyTerms {
public:
  std::optional<double>& operator[](Term term) { return values_[std::size_t(term)]; }
  const std::optional<double>& operator[](Term term) const { return values_[std::size_t(term)]; }
  /// 0 where there is no such term.
  double value(Term term) const { return (*this)[term].value_or(0); }
  /// Of terms that are not built in, by name; all of these are integrals over the membrane.
  std::map<std::string, double>& others() { return others_; }
  const std::map<std::string, double>& others() const { return others_; }
  void add(const TermName& term, double energy);
  double sum() const;
  /// Of those that have this seat.
  double sum(Seat seat) const;

private:
  std::array<std::optional<double>, std::size_t(Term::count)> values_{0.0};
  std::map<std::string, double> others_;
};

} // namespace lamella
