#include "render/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace lamella::render {
namespace {

constexpr std::array<const char*, 10> superscripts{"⁰", "¹", "²", "³", "⁴",
                                                   "⁵", "⁶", "⁷", "⁸", "⁹"};

/// A true minus sign instead of the hyphen.
std::string with_minus(const std::string& text) {
  return text.starts_with('-') ? std::string("−").append(text, 1) : text;
}

/// The largest of 1, 2, 2.5 or 5 times a power of ten that is not above `most`.
double round_step(double most) {
  const double power = std::pow(10, std::floor(std::log10(most) + 1e-9));
  for (double m : {5.0, 2.5, 2.0})
    if (m * power <= most * (1 + 1e-9)) return m * power;
  return power;
}

} // namespace

std::string superscript(int value) {
  std::string text;
  for (char c : std::to_string(value)) text += c == '-' ? "⁻" : superscripts[c - '0'];
  return text;
}

std::string power_of_ten(int exponent) { return "10" + superscript(exponent); }

std::string number(double value, int digits) {
  if (value == 0) return "0";
  const std::string rounded = fmt::format("{:.{}e}", value, digits - 1); // d.dde-03
  const std::size_t e = rounded.find('e');
  const int exponent = std::stoi(rounded.substr(e + 1));
  if (exponent >= -2 && exponent < 5) return with_minus(fmt::format("{:g}", std::stod(rounded)));
  return with_minus(fmt::format("{:g}", std::stod(rounded.substr(0, e)))) + "×" +
         power_of_ten(exponent);
}

int exponent_of(double largest) {
  if (!(largest > 0)) return 0;
  const int magnitude = int(std::floor(std::log10(largest) + 1e-9));
  return magnitude < -2 || magnitude >= 5 ? magnitude : 0;
}

std::string with_power(int exponent, const std::string& unit) {
  if (exponent == 0) return unit;
  return unit.empty() ? power_of_ten(exponent) : power_of_ten(exponent) + " " + unit;
}

std::string grid_label(const std::array<int, 3>& nodes) {
  const auto& [x, y, z] = nodes;
  return x == y && y == z ? fmt::format("{}³", x) : fmt::format("{}×{}×{}", x, y, z);
}

std::string plain(const std::string& text) {
  static const std::vector<std::pair<std::string_view, std::string_view>> replacements{
      {"×", "x"}, {"−", "-"}, {"κ", "kappa"}, {"ζ", "zeta"}, {" ", " "}};
  std::string out;
  bool raised = false; // inside a run of superscripts
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = std::string_view(text).substr(i);
    const auto raise = [&](std::string_view symbol, std::string_view ascii) {
      if (!rest.starts_with(symbol)) return false;
      out += raised ? "" : "^";
      out += ascii;
      i += symbol.size();
      return raised = true;
    };
    bool done = raise("⁻", "-");
    for (int d = 0; d < 10 && !done; ++d) done = raise(superscripts[d], std::to_string(d));
    if (done) continue;
    raised = false;
    const auto found =
        std::find_if(replacements.begin(), replacements.end(),
                     [&](const auto& replacement) { return rest.starts_with(replacement.first); });
    out += found == replacements.end() ? rest.substr(0, 1) : found->second;
    i += found == replacements.end() ? 1 : found->first.size();
  }
  return out;
}

Ticks linear_ticks(double low, double high) {
  const double step = round_step((high - low) / 3);
  Ticks ticks;
  ticks.exponent = exponent_of(std::max(std::abs(low), std::abs(high)));
  const double unit = std::pow(10, ticks.exponent);
  int decimals = 0;
  for (double s = step / unit; std::abs(s - std::round(s)) > 1e-6; s *= 10) ++decimals;
  for (double n = std::ceil(low / step - 1e-6); n * step <= high + 1e-6 * step; ++n) {
    ticks.positions.push_back(n * step);
    ticks.labels.push_back(n == 0 ? "0"
                                  : with_minus(fmt::format("{:.{}f}", n * step / unit, decimals)));
  }
  return ticks;
}

Ticks log_ticks(double low, double high) {
  const int first = int(std::floor(low)), last = int(std::floor(high));
  const int every = (last - first) / 7 + 1;
  const bool short_range = high - low < 2.2;
  Ticks ticks;
  for (int exponent = first; exponent <= last; ++exponent)
    for (int m = 1; m < 10; ++m) {
      const double position = m * std::pow(10, exponent);
      if (std::log10(position) < low || std::log10(position) > high) continue;
      std::string label;
      if (m == 1 && (last - exponent) % every == 0) label = power_of_ten(exponent);
      if (short_range && (m == 1 || m == 2 || m == 5)) label = number(position, 1);
      ticks.positions.push_back(position);
      ticks.labels.push_back(label);
    }
  return ticks;
}

} // namespace lamella::render
