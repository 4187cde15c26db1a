#include "store/run_status.h"

#include "error.h"
#include "regular_file.h"
#include "scene/keys.h"
#include "store/atomic_file.h"
#include "version.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace lamella {

namespace {
constexpr std::array<std::string_view, 4> names{"running", "interrupted", "finished", "stopped"};
constexpr std::size_t longest = 1 << 16;

/// A float of TOML: "2e-05", "1.0".
std::string float_text(double x) {
  const std::string text = fmt::format("{}", x);
  return text.find_first_of(".e") == text.npos ? text + ".0" : text;
}
} // namespace

std::string_view to_string(RunStatus::State state) { return names[std::size_t(state)]; }

std::string hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const unsigned char c : text) hash = (hash ^ c) * 0x100000001b3;
  return fmt::format("{:016x}", hash);
}

void write_status(const Place& place, const RunStatus& s) {
  std::string text = fmt::format("state = {}\n", lamella::quoted(to_string(s.state)));
  if (!s.reason.empty()) text += fmt::format("reason = {}\n", lamella::quoted(s.reason));
  if (!s.origin.empty()) text += fmt::format("origin = {}\n", lamella::quoted(s.origin));
  text += fmt::format("time = {}\nwall_seconds = {:.1f}\nthreads = {}\nscene_hash = {}\n"
                      "program = {}\narithmetic = {}\n",
                      float_text(s.time), s.wall_seconds, s.threads, lamella::quoted(s.scene_hash),
                      lamella::quoted(fmt::format("lamella {}", version())),
                      lamella::quoted(arithmetic()));
  write_text_atomically(place, text);
}

RunStatus read_status(const std::filesystem::path& file) {
  const auto refuse = [&] {
    throw StoreError(fmt::format("{}: not the status of a run", file.string()));
  };
  const std::string text = file_text(file, longest);
  RunStatus status;
  try {
    const toml::table table = toml::parse(text);
    const auto state = std::ranges::find(names, table["state"].value_or(std::string_view()));
    if (state == names.end()) refuse();
    status.state = RunStatus::State(state - names.begin());
    status.reason = table["reason"].value_or("");
    status.origin = table["origin"].value_or("");
    status.time = table["time"].value_or(0.);
    status.wall_seconds = table["wall_seconds"].value_or(0.);
    status.threads = table["threads"].value_or(0);
    status.scene_hash = table["scene_hash"].value_or("");
    if (status.scene_hash.size() != hash_of({}).size()) refuse();
  } catch (const toml::parse_error&) {
    refuse();
  }
  return status;
}

} // namespace lamella
