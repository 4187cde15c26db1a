#pragma once
#include "render/picture.h"
#include "render/sheet.h"

#include <filesystem>
#include <string>

namespace lamella::render {

constexpr double units_per_inch = 400; ///< of sheets

enum class Background { white, transparent };

/// The sheet as an image, so many pixels wide.
Picture print(const Sheet& sheet, int pixels, Background background = Background::white);

/// Write a sheet as the file's extension says: .png (at `dpi` pixels per inch), .pdf or .svg. Lines
/// and letters stay lines and letters in the latter two. The file appears whole or not at all.
/// Throws StoreError, and RenderError for another extension.
void write_sheet(const std::filesystem::path& file, const Sheet& sheet, double dpi = 300,
                 Background background = Background::white);

/// The same for an image, as PNG.
void write_png(const std::filesystem::path& file, const Picture& picture, double dpi = 300);

} // namespace lamella::render
