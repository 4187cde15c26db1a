#include "commands.h"

#include "exit_code.h"
#include "extremes/laws.h"
#include "extremes/random_scene.h"
#include "extremes/report.h"
#include "interrupt.h"
#include "output_folder.h"
#include "parallel.h"
#include "progress.h"
#include "scene/scene_toml.h"
#include "store/atomic_file.h"
#include "usage_error.h"

#include <algorithm>
#include <fmt/format.h>

namespace lamella {

namespace {

constexpr const char *table_file = "extremes.csv", *page_file = "extremes.md",
                     *random_file = "random.csv";

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

/// Runs all, and stores the table anew after each.
std::vector<CaseResult> carry_out(std::span<const ExtremeCase> cases, const Folder& folder) {
  std::vector<CaseResult> results;
  say(extremes_head());
  for (const ExtremeCase& each : cases) {
    CaseResult result = run_case(each, [](double) { return !interrupt_requested(); });
    if (interrupt_requested()) break;
    say(extremes_row(result));
    results.push_back(std::move(result));
    write_text_atomically(Place(folder, table_file), extremes_csv(results));
    write_text_atomically(Place(folder, page_file), extremes_markdown(results));
  }
  return results;
}

/// Of a random scene: its table row, and the scene itself where it broke a law.
std::string note_report(const LawReport& report, const Folder& folder) {
  const Scene& scene = report.run.scene;
  if (!report.broken.empty())
    write_text_atomically(Place(folder, scene.name + ".toml"), to_toml(scene));
  return law_row(report);
}

int check_random_scenes(const ExtremesOptions& options, const Folder& folder) {
  std::string table = law_columns();
  int wrong = 0, done = 0;
  const auto go_on = [] { return !interrupt_requested(); };
  for (int number = 1; number <= options.random && go_on(); number++) {
    const LawReport report = check_laws(random_scene(std::uint64_t(options.seed), number), go_on);
    if (!go_on()) break;
    say(law_text(report));
    table += note_report(report, folder);
    write_text_atomically(Place(folder, random_file), table);
    wrong += !report.broken.empty();
    done++;
  }
  say(fmt::format("{} scene{}: {} broke a law\nIn {}: {}{}\n", done, done == 1 ? "" : "s", wrong,
                  folder.path().string(), random_file,
                  wrong > 0 ? ", and the scenes that did" : ""));
  return interrupt_requested() ? interrupted : wrong > 0 ? unexpected : success;
}

int run_cases(const std::vector<ExtremeCase>& cases, const Folder& folder) {
  const std::vector<CaseResult> results = carry_out(cases, folder);
  say(fmt::format("{}\nIn {}: {}, {}\n", count_of_verdicts(results), folder.path().string(),
                  table_file, page_file));
  if (interrupt_requested()) return interrupted;
  const bool wrong = std::ranges::count(results, Verdict::wrong, &CaseResult::verdict) > 0;
  return wrong ? unexpected : success;
}

} // namespace

int extremes(const ExtremesOptions& options) {
  const bool random = options.random > 0;
  const std::vector<ExtremeCase> cases = random ? std::vector<ExtremeCase>{} : chosen(options);
  const OutputFolder folder(options.folder);
  set_thread_count(options.threads);
  return random ? check_random_scenes(options, *folder) : run_cases(cases, *folder);
}

} // namespace lamella
