// Files of any bytes: read as a checkpoint and as a frame, or refused. An input whose first byte is
// odd is given a checksum that fits, so that what lies behind it is reached too.
#include "error.h"
#include "fuzz.h"
#include "scene/builtin.h"
#include "store/checkpoint.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace lamella::fuzz {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t trailer_size = 37; // "lamella frame, XXH3 ", 16 digits, a newline

fs::path scratch() {
  static const fs::path file =
      fs::temp_directory_path() / fmt::format("lamella-fuzz-{}.hdf", ::getpid());
  return file;
}

std::string content() {
  std::ifstream stream(scratch(), std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A checkpoint with all that there may be, of very few nodes.
Checkpoint small_checkpoint() {
  Checkpoint c;
  c.scene = builtin_scenes().front().text;
  c.stopping.energy_before = 1;
  SimulationState& s = c.state;
  s.steps = 3;
  s.events.resize(2);
  s.domains.push_back({true, {}, 1});
  s.inside.resize(1);
  s.vesicle.phi.assign(8, 0.5);
  s.vesicle.held.resize(1);
  s.vesicle.band = {{1, 2}, Array<double>(2, 0.), Array<double>(2, 0.), Array<double>(2, 0.)};
  s.stepper.rate.assign(2, 1.);
  s.stepper.increment.assign(2, 1.);
  s.stepper.nodal_increment.assign(8, 1.);
  s.stepper.responses.resize(1);
  return c;
}

} // namespace

std::vector<std::string> seeds() {
  const Frame frame{{{2, 2, 2}, 0.1}, 0.1, std::vector<double>(8, 0.5)};
  std::vector<std::string> files;
  for (const char first : {'\0', '\1'}) {
    write_checkpoint(scratch(), frame, small_checkpoint());
    files.push_back(first + content());
    write_frame(scratch(), frame);
    files.push_back(first + content());
  }
  return files;
}

} // namespace lamella::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lamella;
  if (size == 0) return 0;
  std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] % 2 == 1 && bytes.size() > fuzz::trailer_size) {
    bytes.resize(bytes.size() - fuzz::trailer_size);
    bytes += fmt::format("lamella frame, XXH3 {:016x}\n", XXH3_64bits(bytes.data(), bytes.size()));
  }
  std::ofstream(fuzz::scratch(), std::ios::binary) << bytes;
  try {
    read_frame(fuzz::scratch());
  } catch (const StoreError&) {
  }
  try {
    const Scene scene = builtin_scene("fig3_oblate", std::vector<std::string>{"grid.nodes=24"});
    Simulation(scene, read_checkpoint(fuzz::scratch()).state);
  } catch (const StoreError&) {
  } catch (const RunError&) {
  }
  std::filesystem::remove(fuzz::scratch());
  return 0;
}
