#include "commands.h"

#include "error.h"
#include "exit_code.h"
#include "extremes/report.h"
#include "interrupt.h"
#include "parallel.h"
#include "progress.h"
#include "store/atomic_file.h"
#include "usage_error.h"

#include <algorithm>
#include <fmt/format.h>

namespace lamella {

namespace fs = std::filesystem;

namespace {

constexpr const char *table_file = "extremes.csv", *page_file = "extremes.md";

/// Those that the options ask for. Throws UsageError where these are none.
std::vector<ExtremeCase> chosen(const ExtremesOptions& options) {
  std::vector<ExtremeCase> cases;
  for (const ExtremeCase& each : extreme_cases())
    if ((each.quick || !options.quick) && each.name.find(options.only) != each.name.npos)
      cases.push_back(each);
  if (cases.empty())
    throw UsageError(fmt::format("--only \"{}\": no case has that in its name; allowed: a part of "
                                 "a name, as in --only prolate or --only \"C = -60\"",
                                 options.only));
  return cases;
}

void create(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw StoreError(
        fmt::format("{}: cannot be used as output folder: {}", folder.string(), error.message()));
}

/// Runs all, and stores the table anew after each.
std::vector<CaseResult> carry_out(std::span<const ExtremeCase> cases, const fs::path& folder) {
  std::vector<CaseResult> results;
  say(extremes_head());
  for (const ExtremeCase& each : cases) {
    CaseResult result = run_case(each, [](double) { return !interrupt_requested(); });
    if (interrupt_requested()) break;
    say(extremes_row(result));
    results.push_back(std::move(result));
    write_text_atomically(folder / table_file, extremes_csv(results));
    write_text_atomically(folder / page_file, extremes_markdown(results));
  }
  return results;
}

} // namespace

int extremes(const ExtremesOptions& options) {
  const std::vector<ExtremeCase> cases = chosen(options);
  create(options.folder);
  set_thread_count(options.threads);
  watch_for_interrupt();
  const std::vector<CaseResult> results = carry_out(cases, options.folder);
  say(fmt::format("{}\nIn {}: {}, {}\n", count_of_verdicts(results), options.folder.string(),
                  table_file, page_file));
  if (interrupt_requested()) return interrupted;
  const bool wrong = std::ranges::count(results, Verdict::wrong, &CaseResult::verdict) > 0;
  return wrong ? unexpected : success;
}

} // namespace lamella
