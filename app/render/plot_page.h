#pragma once
#include "render/sheet.h"
#include "render/studio.h"

#include <string>
#include <vector>

/// The page on which plots stand: an axis below, one at the left, each with ticks and a title.
namespace lamella::render::plot_page {

constexpr double width = 1400, height = 1050;
constexpr double right = 1325, bottom = 180,
                 top = 1005; ///< at most, of the plot; its left side follows from the labels

/// Left side of a plot, with room for the labels of its left axis and their title.
double left_side(const std::vector<std::string>& labels);

/// Ticks without a label are minor ones.
void draw_bottom_tick(Sheet& sheet, double x, const std::string& label = "");
void draw_left_tick(Sheet& sheet, double left, double y, const std::string& label = "");

/// Of the axes of a plot from `left` to `right`.
void draw_titles(Sheet& sheet, double left, double right, const std::string& below,
                 const std::string& at_left);

/// `pixels` wide, and 3/4 as high. Throws RenderError.
Picture print(Studio& studio, const Sheet& sheet, int pixels);

} // namespace lamella::render::plot_page
