// What the built-in scenes cost, each as `lamella run NAME --no-pictures`, as a Markdown table:
//   scene_costs                   all of them
//   scene_costs fig6a fig8b       some
#include "scene/builtin.h"
#include "store/history.h"

#include <chrono>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lamella {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Cost {
  int status = 0; ///< exit code of the run
  double seconds = 0;
  long peak_memory = 0; ///< bytes
};

Cost run(const std::string& scene, const fs::path& folder) {
  std::vector<std::string> words{LAMELLA_PROGRAM, "run",          scene, "-o",
                                 folder.string(), "--no-pictures"};
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t silent;
  posix_spawn_file_actions_init(&silent);
  posix_spawn_file_actions_addopen(&silent, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);

  const auto begin = Clock::now();
  pid_t id = 0;
  if (posix_spawn(&id, argv[0], &silent, nullptr, argv.data(), environ) != 0) return {-1};
  int status = 0;
  rusage usage{};
  wait4(id, &status, 0, &usage);
  posix_spawn_file_actions_destroy(&silent);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          std::chrono::duration<double>(Clock::now() - begin).count(), 1024 * usage.ru_maxrss};
}

std::string row(const std::string& name, const fs::path& folder) {
  const Cost cost = run(name, folder);
  const Grid grid = builtin_scene(name).grid();
  std::string text = fmt::format("| {} | {} x {} x {} |", name, grid.nx(), grid.ny(), grid.nz());
  if (!fs::exists(folder / "history.csv"))
    return text + fmt::format(" does not start: exit code {} | | | | | | | |\n", cost.status);
  const std::vector<Measures> history = read_history(folder / "history.csv");
  const Measures& end = history.back();
  const std::size_t steps = history.size() - 1;
  return text + fmt::format(" {:g}{} | {} | {:.1f} s | {:.1f} | {:.0f} MB | {} | {} | {:.6g} |\n",
                            end.time, cost.status == 0 ? "" : ", stopped", steps, cost.seconds,
                            1e3 * cost.seconds / double(steps), 1e-6 * double(cost.peak_memory),
                            end.components, end.genus, end.energy);
}

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

void measure(const std::vector<std::string>& names) {
  std::string base = (fs::temp_directory_path() / "lamella-costs-XXXXXX").string();
  if (!mkdtemp(base.data())) throw std::runtime_error("no temporary folder");
  print(
      "| scene | grid | end time | steps | wall time | ms/step | peak memory | components | genus "
      "| energy |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& name : names) print(row(name, fs::path(base) / name));
  fs::remove_all(base);
}

} // namespace
} // namespace lamella

int main(int argc, char** argv) {
  std::vector<std::string> names(argv + 1, argv + argc);
  if (names.empty())
    for (const lamella::BuiltinScene& scene : lamella::builtin_scenes())
      names.emplace_back(scene.name);
  try {
    lamella::measure(names);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "scene_costs: %s\n", e.what());
    return 1;
  }
}
