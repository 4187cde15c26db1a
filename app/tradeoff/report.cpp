#include "tradeoff/report.h"

#include "kernels/kernels.h"
#include "parallel.h"

#include <fmt/format.h>

#include <cmath>

namespace lamella {

namespace {

std::string error_text(double error) {
  return std::isnan(error) ? "-" : fmt::format("{:.1e}", error);
}

std::string cell(double value) { return std::isnan(value) ? "" : fmt::format("{:.12g}", value); }

std::string quoted_cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('"', at)) != text.npos; at += 2) text.insert(at, 1, '"');
  return text.empty() ? "" : '"' + text + '"';
}

std::string markdown_row(const Trial& trial) {
  std::string row =
      fmt::format("| {} | {:g} | {} | {} | {:.2f} s |", grid_text(trial.scene),
                  trial.scene.numerics.tolerance, trial.preset, trial.steps(), trial.seconds);
  const Errors& e = trial.errors;
  for (const double error : {e.course, e.energy, e.P, e.sigma})
    row += ' ' + error_text(error) + " |";
  std::string total = trial.stopped.empty() ? error_text(e.largest()) : "stopped: " + trial.stopped;
  if (trial.on_front) total = "**" + total + "**";
  return row + " " + total + " |\n";
}

} // namespace

std::string grid_text(const Scene& scene) {
  const auto& [x, y, z] = scene.nodes;
  return x == y && y == z ? fmt::format("{}^3", x) : fmt::format("{}x{}x{}", x, y, z);
}

std::string table_head() {
  return fmt::format("{:<12} {:>9}  {:<8} {:>6} {:>10} {:>8} {:>8} {:>8} {:>8}  {:>8}\n", "grid",
                     "tolerance", "preset", "steps", "time", "E(t)", "E", "P", "sigma", "largest");
}

std::string table_row(const Trial& trial) {
  const Errors& e = trial.errors;
  std::string row =
      fmt::format("{:<12} {:>9g}  {:<8} {:>6} {:>8.2f} s ", grid_text(trial.scene),
                  trial.scene.numerics.tolerance, trial.preset, trial.steps(), trial.seconds);
  if (!trial.stopped.empty()) return row + "stopped: " + trial.stopped + "\n";
  for (const double error : {e.course, e.energy, e.P, e.sigma})
    row += fmt::format("{:>8} ", error_text(error));
  return row + fmt::format(" {:>8}\n", error_text(e.largest()));
}

std::string tradeoff_csv(std::span<const Trial> trials) {
  std::string csv =
      "nx,ny,nz,tolerance,preset,steps,seconds,energy,P,sigma,error_course,error_energy,"
      "error_P,error_sigma,error,pareto,stopped\n";
  for (const Trial& trial : trials) {
    const auto& [x, y, z] = trial.scene.nodes;
    csv += fmt::format("{},{},{},{:g},{},{},{:.6g}", x, y, z, trial.scene.numerics.tolerance,
                       trial.preset, trial.steps(), trial.seconds);
    const auto at_end = [&](double Measures::*number) {
      return trial.history.empty() ? NAN : trial.history.back().*number;
    };
    const Errors& e = trial.errors;
    for (const double value :
         {at_end(&Measures::energy), at_end(&Measures::P), at_end(&Measures::sigma), e.course,
          e.energy, e.P, e.sigma, e.largest()})
      csv += ',' + cell(value);
    csv += fmt::format(",{:d},{}\n", trial.on_front, quoted_cell(trial.stopped));
  }
  return csv;
}

std::string tradeoff_markdown(const Scene& scene, const Reference& reference,
                              std::span<const Trial> trials, int repeats) {
  std::string page = fmt::format(
      "# {}: speed against accuracy\n\n"
      "To t = {:g}, compared with {}, on {} thread{} with {} kernels. Times are {}, without "
      "storing "
      "and drawing.\n\n"
      "![Error against wall time](tradeoff.png)\n\n"
      "Relative errors: E(t), of the energy over the run (mean over the logarithm of time, last "
      "two "
      "decades); E, P and sigma at its end; and the largest of them. Bold, and full dots in the "
      "picture, where no run is both faster and more accurate (the Pareto front).\n\n"
      "| grid | tolerance | preset | steps | time | E(t) | E | P | sigma | largest |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n",
      scene.name, scene.end(), reference.source(), thread_count(), thread_count() == 1 ? "" : "s",
      kernels().name,
      repeats == 1 ? "of single runs" : fmt::format("the least of {} runs", repeats));
  for (const Trial& trial : trials) page += markdown_row(trial);
  return page;
}

} // namespace lamella
