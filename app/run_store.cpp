#include "run_store.h"

#include "regular_file.h"
#include "scene/scene_toml.h"
#include "store/atomic_file.h"
#include "version.h"

#include <QCryptographicHash>

#include <fmt/format.h>

namespace lamella {

namespace fs = std::filesystem;

namespace {

/// Nothing for what is not a file, such as the name of a built-in scene.
std::string content(const fs::path& file) { return file.is_absolute() ? file_text(file) : ""; }

std::string key_of(const Scene& scene) {
  QCryptographicHash hash(QCryptographicHash::Sha256);
  for (const std::string& part : {std::string(version()), to_toml(scene), content(scene.shape.file),
                                  content(scene.domains.file)})
    hash.addData(part.data(), int(part.size()));
  return hash.result().toHex().left(12).toStdString();
}

} // namespace

fs::path RunStore::place(const Scene& scene) const {
  return folder_.path() / fmt::format("{}-{}", scene.name, key_of(scene));
}

bool RunStore::has(const Scene& scene) const {
  std::error_code ignored;
  return fs::is_directory(place(scene), ignored);
}

RunStore::Order RunStore::begin(const Scene& scene) const {
  const std::string name = place(scene).filename();
  folder_.find(name + ".part"); // refuses a link
  write_text_atomically(Place(folder_, name + ".toml"), to_toml(scene));
  return {folder_.path() / (name + ".toml"), folder_.path() / (name + ".part")};
}

void RunStore::finish(const Scene& scene) const {
  const std::string name = place(scene).filename();
  folder_.rename(name + ".part", name);
  folder_.remove(name + ".toml");
}

} // namespace lamella
