// Files of any bytes: read as a checkpoint and as a frame, or refused. An input whose first byte is
// odd is a list of changes to the numbers in a good file, which then has a checksum that fits: what
// lies behind it is reached too, but not HDF5 with bytes that it did not write (1.10 reads beyond
// its buffers there).
#include "error.h"
#include "fuzz.h"
#include "scene/builtin.h"
#include "store/checkpoint.h"

#include <fmt/format.h>
#include <hdf5.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string_view>
#include <unistd.h>
#include <utility>

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

/// The good files: a checkpoint and a frame.
std::array<std::string, 2> good_files() {
  const Frame frame{{{2, 2, 2}, 0.1}, 0.1, std::vector<double>(8, 0.5)};
  std::array<std::string, 2> files;
  write_checkpoint(scratch(), frame, small_checkpoint());
  files[0] = content();
  write_frame(scratch(), frame);
  files[1] = content();
  return files;
}

/// Bytes of a value that is changed, and what they become.
struct Change {
  std::uint16_t value;
  std::uint16_t at;
  std::array<unsigned char, 8> bytes;
};

void overwrite(std::span<unsigned char> bytes, const Change& change) {
  const std::size_t at = change.at % bytes.size();
  std::copy_n(change.bytes.begin(), std::min(change.bytes.size(), bytes.size() - at),
              bytes.begin() + long(at));
}

std::vector<unsigned char> bytes_for(hid_t type, hid_t space) {
  return std::vector<unsigned char>(H5Tget_size(type) *
                                    std::size_t(H5Sget_simple_extent_npoints(space)));
}

void change_dataset(hid_t file, const char* name, const Change& change) {
  const hid_t data = H5Dopen2(file, name, H5P_DEFAULT), type = H5Dget_type(data),
              space = H5Dget_space(data);
  if (std::vector<unsigned char> bytes = bytes_for(type, space); !bytes.empty()) {
    H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
    overwrite(bytes, change);
    H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
  }
  H5Sclose(space);
  H5Tclose(type);
  H5Dclose(data);
}

void change_attribute(hid_t file, const char* object_name, const char* name, const Change& change) {
  const hid_t object = H5Oopen(file, object_name, H5P_DEFAULT),
              old = H5Aopen(object, name, H5P_DEFAULT), type = H5Aget_type(old),
              space = H5Aget_space(old);
  std::vector<unsigned char> bytes = bytes_for(type, space);
  H5Aread(old, type, bytes.data());
  H5Aclose(old);
  if (!bytes.empty()) {
    overwrite(bytes, change);
    H5Adelete(object, name);
    const hid_t changed = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(changed, type, bytes.data());
    H5Aclose(changed);
  }
  H5Sclose(space);
  H5Tclose(type);
  H5Oclose(object);
}

struct Values {
  std::vector<std::pair<std::string, std::string>> names; ///< object, attribute; none: a dataset
};

herr_t collect(hid_t root, const char* name, const H5O_info_t* info, void* values) {
  auto& names = static_cast<Values*>(values)->names;
  if (info->type == H5O_TYPE_DATASET) names.emplace_back(name, "");
  const hid_t object = H5Oopen(root, name, H5P_DEFAULT);
  for (hsize_t n = 0; n < info->num_attrs; n++) {
    char attribute[256];
    H5Aget_name_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC, n, attribute, sizeof attribute,
                       H5P_DEFAULT);
    names.emplace_back(name, attribute);
  }
  H5Oclose(object);
  return 0;
}

void apply(hid_t file, const Values& values, const Change& change) {
  const auto& [name, attribute] = values.names[change.value % values.names.size()];
  if (attribute.empty())
    change_dataset(file, name.c_str(), change);
  else
    change_attribute(file, name.c_str(), attribute.c_str(), change);
}

/// The first byte chooses the file, each twelve after it are a change.
std::string changed(std::string_view changes) {
  static const std::array<std::string, 2> files = good_files();
  if (changes.empty()) return files[0];
  std::string image = files[std::size_t(changes[0]) % 2];
  image.resize(image.size() - trailer_size);
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_core(access, 1 << 16, false);
  H5Pset_file_image(access, image.data(), image.size());
  const hid_t file = H5Fopen("changed", H5F_ACC_RDWR, access);
  Values values;
  H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, collect, &values,
            H5O_INFO_BASIC | H5O_INFO_NUM_ATTRS);
  for (std::size_t at = 1; at + sizeof(Change) <= changes.size(); at += sizeof(Change)) {
    Change change;
    std::memcpy(&change, changes.data() + at, sizeof change);
    apply(file, values, change);
  }
  H5Fflush(file, H5F_SCOPE_GLOBAL);
  image.resize(std::size_t(H5Fget_file_image(file, nullptr, 0)));
  H5Fget_file_image(file, image.data(), image.size());
  H5Fclose(file);
  H5Pclose(access);
  return image +
         fmt::format("lamella frame, XXH3 {:016x}\n", XXH3_64bits(image.data(), image.size()));
}

} // namespace

std::vector<std::string> seeds() {
  std::vector<std::string> inputs;
  for (const std::string& file : good_files()) inputs.push_back('\0' + file);
  for (const char file : {'\0', '\1'}) {
    std::string input{'\1', file};
    for (int n = 0; n < 40; n++) input += std::string(sizeof(Change), char(7 * n));
    inputs.push_back(input);
  }
  return inputs;
}

} // namespace lamella::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lamella;
  if (size == 0) return 0;
  const std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::string bytes = data[0] % 2 == 1 ? fuzz::changed(rest) : std::string(rest);
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
