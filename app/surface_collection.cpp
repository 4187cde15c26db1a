#include "surface_collection.h"

#include "error.h"
#include "regular_file.h"
#include "store/atomic_file.h"

#include <fmt/format.h>

#include <regex>

namespace lamella {

namespace fs = std::filesystem;

namespace {

constexpr const char *head = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" "
                             "version=\"0.1\">\n  <Collection>\n",
                     *tail = "  </Collection>\n</VTKFile>\n";

/// What a collection lists; nothing where the list is not one that this program wrote.
std::vector<std::string> listed(const fs::path& list, const std::string& collection) {
  const std::string text = file_text(list);
  const std::regex whole(fmt::format(
      R"({}(?:    <DataSet timestep="[^"\n]*" file="{}_\d{{4,}}\.vtp"/>\n)*{})",
      std::regex_replace(std::string(head), std::regex(R"([.?])"), R"(\$&)"), collection, tail));
  if (!std::regex_match(text, whole)) return {};
  std::vector<std::string> files{list.filename().string()};
  const std::regex entry(fmt::format(R"re(file="({}_\d+\.vtp)")re", collection));
  for (std::sregex_iterator at(text.begin(), text.end(), entry), end; at != end; ++at)
    files.push_back((*at)[1]);
  return files;
}

} // namespace

std::string surface_file(const std::string& collection, std::size_t frame) {
  return fmt::format("{}_{:04}.vtp", collection, frame);
}

void SurfaceCollection::add(std::size_t frame, double time, const std::string& vtp) {
  const std::string file = surface_file(name_, frame);
  entries_ += fmt::format("    <DataSet timestep=\"{}\" file=\"{}\"/>\n", time, file);
  write_list();
  write_text_atomically(Place(folder_, file), vtp);
}

void SurfaceCollection::write_list() const {
  write_text_atomically(Place(folder_, name_ + ".pvd"), head + entries_ + tail);
}

std::vector<std::string> exported_files(const Folder& folder) {
  std::vector<std::string> files;
  for (const std::string collection : {"membrane", "boundary"}) {
    const std::string list = collection + ".pvd";
    if (folder.type_of(list) != fs::file_type::regular) continue;
    for (std::string& file : listed(folder.path() / list, collection))
      if (folder.type_of(file) == fs::file_type::regular) files.push_back(std::move(file));
  }
  return files;
}

} // namespace lamella
