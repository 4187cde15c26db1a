#include "extremes/report.h"

#include "extremes/known_answer.h"
#include "kernels/kernels.h"
#include "parallel.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace lamella {

namespace {

constexpr Verdict verdicts[]{Verdict::right,   Verdict::consistent, Verdict::warned,
                             Verdict::stopped, Verdict::refused,    Verdict::wrong};

std::string error_text(double error) {
  return std::isnan(error) ? "-" : fmt::format("{:.1e}", error);
}

std::string number_text(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.6g}", value);
}

/// What the run itself said, and what is to be said of it.
std::string notes(const CaseResult& result) {
  std::vector<std::string> parts;
  if (const int changes = result.topology_changes(); changes > 0 && result.ending == Ending::ended)
    parts.push_back(fmt::format("{} topology change{}, {} component{} of genus {} at the end",
                                changes, changes == 1 ? "" : "s", result.end.components,
                                result.end.components == 1 ? "" : "s", result.end.genus));
  if (const Event* event = result.first_unresolved())
    parts.push_back(to_text(*event, result.scene.grid().spacing));
  if (result.ending == Ending::hung) parts.emplace_back("it did not come to an end");
  if (!result.finite) parts.emplace_back("a number is not finite");
  if (!result.message.empty())
    parts.push_back(result.ending == Ending::stopped
                        ? fmt::format("stopped at t = {:.6g}: {}", result.end.time, result.message)
                        : result.message);
  return fmt::format("{}", fmt::join(parts, ". "));
}

std::string markdown_row(const CaseResult& result) {
  const bool ran = result.ending != Ending::refused;
  const std::string verdict(to_string(result.verdict()));
  const Errors& e = result.errors;
  std::string row =
      fmt::format("| {} | {} | {} | {} |", result.which.name, verdict,
                  ran ? number_text(result.end.int_KM2) : "-", number_text(result.exact.int_KM2));
  for (const double error : {e.energy, e.P, e.sigma}) row += ' ' + error_text(error) + " |";
  return row + fmt::format(" {} | {:.1f} s | {} |\n", result.steps, result.seconds, notes(result));
}

std::string cell(double value) { return std::isnan(value) ? "" : fmt::format("{:.9g}", value); }

std::string quoted_cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('"', at)) != text.npos; at += 2) text.insert(at, 1, '"');
  return text.empty() ? "" : '"' + text + '"';
}

std::string csv_row(const CaseResult& result) {
  const Measures& end = result.end;
  const Errors& e = result.errors;
  std::string row =
      fmt::format("{},{},{}", quoted_cell(std::string(result.which.name)),
                  quoted_cell(std::string(result.which.scene)), to_string(result.ending));
  for (const double value :
       {end.time, end.energy, end.int_KM2, end.P, end.sigma, end.reduced_volume,
        end.area_difference, result.exact.int_KM2, result.exact.P, result.exact.sigma, e.energy,
        e.P, e.sigma, result.energy_rise, result.drift, result.seconds})
    row += ',' + cell(value);
  return row + fmt::format(",{},{},{},{},{},{}\n", result.steps, result.topology_changes(),
                           end.components, end.genus, to_string(result.verdict()),
                           quoted_cell(notes(result)));
}

} // namespace

std::string extremes_head() {
  return fmt::format("{:<32} {:<11} {:>8} {:>8} {:>8} {:>6} {:>8}\n", "case", "verdict", "E", "P",
                     "sigma", "steps", "time");
}

std::string extremes_row(const CaseResult& result) {
  const Errors& e = result.errors;
  const std::string more = notes(result);
  return fmt::format("{:<32} {:<11} {:>8} {:>8} {:>8} {:>6} {:>6.1f} s\n{}", result.which.name,
                     to_string(result.verdict()), error_text(e.energy), error_text(e.P),
                     error_text(e.sigma), result.steps, result.seconds,
                     more.empty() ? "" : fmt::format("    {}\n", more));
}

std::string count_of_verdicts(std::span<const CaseResult> results) {
  std::vector<std::string> counts;
  for (const Verdict verdict : verdicts)
    counts.push_back(fmt::format(
        "{} {}", std::ranges::count(results, verdict, &CaseResult::verdict), to_string(verdict)));
  return fmt::format("{} case{}: {}", results.size(), results.size() == 1 ? "" : "s",
                     fmt::join(counts, ", "));
}

std::string extremes_csv(std::span<const CaseResult> results) {
  std::string csv = "case,scene,ending,t,energy,int_KM2,P,sigma,v,Da,exact_int_KM2,exact_P,"
                    "exact_sigma,error_energy,error_P,error_sigma,energy_rise,drift,seconds,steps,"
                    "topology_changes,components,genus,verdict,notes\n";
  for (const CaseResult& result : results) csv += csv_row(result);
  return csv;
}

std::string extremes_markdown(std::span<const CaseResult> results) {
  std::string page = fmt::format(
      "# Extreme cases\n\n{}; {} thread{}, {} kernels.\n\n"
      "Relative errors of int K_M^2 dA, P and sigma, where the exact answer is known; extremes.csv "
      "has the scenes.\n\n"
      "| case | verdict | int K_M^2 dA | exact | its error | P | sigma | steps | time | notes |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n",
      count_of_verdicts(results), thread_count(), thread_count() == 1 ? "" : "s", kernels().name);
  for (const CaseResult& result : results) page += markdown_row(result);
  return page;
}

std::string law_text(const LawReport& report) {
  const Trace& run = report.run;
  const std::size_t steps = run.history.empty() ? 0 : run.history.size() - 1;
  std::string text = fmt::format("{:<18} {:>3} steps  {}\n", run.scene.name, steps,
                                 report.broken.empty() ? "obeys" : "BREAKS A LAW");
  if (!run.message.empty()) text += fmt::format("    stopped: {}\n", run.message);
  for (const BrokenLaw& law : report.broken) text += fmt::format("    {}: {}\n", law.law, law.how);
  return text;
}

std::string law_columns() { return "scene,phases,steps,t,energy,events,stopped,broken\n"; }

std::string law_row(const LawReport& report) {
  const Trace& run = report.run;
  const bool started = !run.history.empty();
  std::vector<std::string> broken;
  for (const BrokenLaw& law : report.broken)
    broken.push_back(fmt::format("{}: {}", law.law, law.how));
  return fmt::format(
      "{},{},{},{},{},{},{},{}\n", run.scene.name, run.scene.has_phases() ? 2 : 1,
      started ? run.history.size() - 1 : 0, started ? cell(run.history.back().time) : "",
      started ? cell(run.history.back().energy) : "", run.events.size(), quoted_cell(run.message),
      quoted_cell(fmt::format("{}", fmt::join(broken, "; "))));
}

} // namespace lamella
