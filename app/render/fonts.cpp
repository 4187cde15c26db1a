#include "render/fonts.h"

#include <vtkTextProperty.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <vector>

namespace lamella::render {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 3> file_names{"DejaVuSans.ttf", "DejaVuSans-Bold.ttf",
                                                "DejaVuSans-Oblique.ttf"};

std::vector<fs::path> font_folders() {
  std::vector<fs::path> folders{"/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu",
                                "/usr/share/fonts/dejavu-sans-fonts", "/usr/share/fonts/TTF"};
  if (const char* home = std::getenv("HOME")) {
    folders.push_back(fs::path(home) / ".local/share/fonts");
    folders.push_back(fs::path(home) / ".fonts");
  }
  folders.insert(folders.end(), {"/usr/local/share/fonts", "/usr/share/fonts"});
  return folders;
}

/// The folder that holds DejaVu Sans: the known places first, then anywhere below them.
fs::path find_dejavu() {
  const std::vector<fs::path> folders = font_folders();
  std::error_code ignored;
  for (const fs::path& folder : folders)
    if (fs::exists(folder / file_names[0], ignored)) return folder;
  constexpr auto options = fs::directory_options::skip_permission_denied;
  for (const fs::path& folder : folders)
    for (fs::recursive_directory_iterator it(folder, options, ignored), end; it != end;
         it.increment(ignored))
      if (it->path().filename() == file_names[0]) return it->path().parent_path();
  return {};
}

} // namespace

bool set_face(vtkTextProperty& property, Face face) {
  static const fs::path folder = find_dejavu();
  if (folder.empty()) {
    property.SetFontFamilyToArial();
    property.SetBold(face == Face::bold);
    property.SetItalic(face == Face::oblique);
    return false;
  }
  std::error_code ignored;
  fs::path file = folder / file_names[std::size_t(face)];
  if (!fs::exists(file, ignored)) file = folder / file_names[0]; // fonts-dejavu-core has no oblique
  property.SetFontFamily(VTK_FONT_FILE);
  property.SetFontFile(file.c_str());
  return true;
}

} // namespace lamella::render
