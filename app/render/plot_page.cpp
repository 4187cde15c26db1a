#include "render/plot_page.h"

#include "render/labels.h"
#include "render/style.h"

#include <algorithm>
#include <cmath>

namespace lamella::render::plot_page {
namespace {

constexpr double title_at = 70; ///< base line of the left axis' title
constexpr double tick = 16, minor_tick = 9;
constexpr Stroke line{style::hairline, style::ink};

double length(const std::string& label) { return label.empty() ? minor_tick : tick; }

/// Width of a label, at most, in digits.
double digits(const std::string& label) {
  constexpr double raised = 0.6;
  const std::string text = plain(label);
  const std::size_t base = std::min(text.find('^'), text.size());
  return double(base) + (base < text.size() ? raised * double(text.size() - base - 1) : 0);
}

} // namespace

double left_side(const std::vector<std::string>& labels) {
  double longest = 0;
  for (const std::string& label : labels) longest = std::max(longest, digits(label));
  constexpr double digit = 0.64 * style::small_type; // widest
  return title_at + 80 + longest * digit + tick;
}

void draw_bottom_tick(Sheet& sheet, double x, const std::string& label) {
  sheet.line({{x, bottom}, {x, bottom - length(label)}}, line);
  sheet.text({x, bottom - tick - 14 - 0.73 * style::small_type}, label,
             {style::small_type, style::ink, 0.5});
}

void draw_left_tick(Sheet& sheet, double left, double y, const std::string& label) {
  sheet.line({{left - length(label), y}, {left, y}}, line);
  sheet.text({left - tick - 12, y - 0.36 * style::small_type}, label,
             {style::small_type, style::ink, 1});
}

void draw_titles(Sheet& sheet, double left, double right, const std::string& below,
                 const std::string& at_left) {
  TextStyle style{style::type_size, style::ink, 0.5};
  sheet.text({(left + right) / 2, 50}, below, style);
  style.upright = false;
  sheet.text({title_at, (bottom + top) / 2}, at_left, style);
}

Picture print(Studio& studio, const Sheet& sheet, int pixels) {
  const double scale = pixels / width;
  return studio.shoot(pixels, int(std::lround(height * scale)), {}, sheet, scale);
}

} // namespace lamella::render::plot_page
