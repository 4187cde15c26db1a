#include "run_store.h"

#include "error.h"
#include "scene/scene_toml.h"
#include "store/atomic_file.h"
#include "version.h"

#include <QCryptographicHash>

#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace lamella {

namespace fs = std::filesystem;

namespace {

/// Nothing for what is not a file, such as the name of a built-in scene.
std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return file.is_absolute() ? std::string{std::istreambuf_iterator<char>(stream), {}}
                            : std::string();
}

std::string key_of(const Scene& scene) {
  QCryptographicHash hash(QCryptographicHash::Sha256);
  for (const std::string& part : {std::string(version()), to_toml(scene), content(scene.shape.file),
                                  content(scene.domains.file)})
    hash.addData(part.data(), int(part.size()));
  return hash.result().toHex().left(12).toStdString();
}

} // namespace

fs::path RunStore::place(const Scene& scene) const {
  return folder_ / fmt::format("{}-{}", scene.name, key_of(scene));
}

bool RunStore::has(const Scene& scene) const {
  std::error_code ignored;
  return fs::is_directory(place(scene), ignored);
}

RunStore::Order RunStore::begin(const Scene& scene) const {
  const fs::path place = this->place(scene);
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error)
    throw StoreError(
        fmt::format("{}: cannot be used as a folder: {}", folder_.string(), error.message()));
  const Order order{place.string() + ".toml", place.string() + ".part"};
  write_text_atomically(order.scene, to_toml(scene));
  return order;
}

void RunStore::finish(const Scene& scene) const {
  const fs::path place = this->place(scene);
  std::error_code error;
  fs::rename(place.string() + ".part", place, error);
  if (error) throw StoreError(fmt::format("{}: {}", place.string(), error.message()));
  fs::remove(place.string() + ".toml", error);
}

} // namespace lamella
