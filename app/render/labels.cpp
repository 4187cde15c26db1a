#include "render/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
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

/// Digits behind the point, so that nothing is rounded.
int decimals_of(double value) {
  int decimals = 0;
  for (; std::abs(value - std::round(value)) > 1e-6; value *= 10) ++decimals;
  return decimals;
}

long count_labels(const std::vector<std::string>& labels) {
  return std::ranges::count_if(labels, [](const std::string& label) { return !label.empty(); });
}

/// Whether no label reaches into the next; `places` are those of the ticks, in parts of the axis.
bool stay_apart(const std::vector<std::string>& labels, const std::vector<double>& places,
                const LabelRoom& room) {
  double taken = -std::numeric_limits<double>::infinity(); // as far as here
  for (std::size_t n = 0; n < labels.size(); ++n) {
    if (labels[n].empty()) continue;
    const double middle = places[n] * room.axis, half = room.label(labels[n]) / 2;
    if (middle - half < taken) return false;
    taken = middle + half;
  }
  return true;
}

/// Labels of the chosen values, all with the same number of digits; those of others are empty.
std::vector<std::string> written(const std::vector<double>& values,
                                 const std::function<bool(std::size_t)>& chosen) {
  int decimals = 0;
  for (std::size_t n = 0; n < values.size(); ++n)
    if (chosen(n)) decimals = std::max(decimals, decimals_of(values[n]));
  std::vector<std::string> labels(values.size());
  for (std::size_t n = 0; n < values.size(); ++n)
    if (chosen(n))
      labels[n] = values[n] == 0 ? "0" : with_minus(fmt::format("{:.{}f}", values[n], decimals));
  return labels;
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

Ticks linear_ticks(double low, double high, const LabelRoom& room) {
  const double step = round_step((high - low) / 3);
  const double first = std::ceil(low / step - 1e-6);
  const std::size_t count = std::size_t(std::floor(high / step + 1e-6) - first) + 1;
  Ticks ticks;
  ticks.exponent = exponent_of(std::max(std::abs(low), std::abs(high)));
  std::vector<double> places, values;
  for (std::size_t n = 0; n < count; ++n) {
    const double position = (first + double(n)) * step;
    ticks.positions.push_back(position);
    places.push_back((position - low) / (high - low));
    values.push_back(position / std::pow(10, ticks.exponent));
  }
  for (std::size_t every = 1; every <= count; ++every) {
    // Multiples of the larger step, where there are two of them.
    const auto multiple = std::size_t(std::ceil(first / double(every)) * double(every) - first);
    const std::size_t from = multiple + every < count ? multiple : 0;
    ticks.labels =
        written(values, [=](std::size_t n) { return n >= from && (n - from) % every == 0; });
    if (stay_apart(ticks.labels, places, room)) break; // a label alone does
  }
  return ticks;
}

Ticks log_ticks(double low, double high, const LabelRoom& room) {
  struct Tick {
    int mantissa, exponent;
  };
  std::vector<Tick> all;
  Ticks ticks;
  std::vector<double> places;
  const int first = int(std::floor(low)), last = int(std::floor(high));
  for (int exponent = first; exponent <= last; ++exponent)
    for (int m = 1; m < 10; ++m) {
      const double position = m * std::pow(10, exponent), place = std::log10(position);
      if (place < low || place > high) continue;
      all.push_back({m, exponent});
      ticks.positions.push_back(position);
      places.push_back((place - low) / (high - low));
    }
  const bool short_range = high - low < 2.2;
  std::vector<std::function<bool(std::size_t)>> choices;
  if (short_range)
    choices.push_back([&](std::size_t n) {
      return all[n].mantissa == 1 || all[n].mantissa == 2 || all[n].mantissa == 5;
    });
  for (int every = 1; every <= last - first + 1; ++every)
    choices.push_back([&, every](std::size_t n) {
      return all[n].mantissa == 1 && (last - all[n].exponent) % every == 0;
    });
  if (short_range)
    for (std::size_t every = 1; every <= all.size(); ++every)
      choices.push_back([every](std::size_t n) { return n % every == 0; });
  ticks.labels.resize(all.size());
  for (const auto& chosen : choices) {
    std::vector<std::string> labels(all.size());
    for (std::size_t n = 0; n < all.size(); ++n)
      if (chosen(n))
        labels[n] = short_range ? number(ticks.positions[n], 1) : power_of_ten(all[n].exponent);
    if (!stay_apart(labels, places, room)) continue;
    if (count_labels(labels) > count_labels(ticks.labels)) ticks.labels = labels;
    if (count_labels(labels) > 1) break;
  }
  return ticks;
}

} // namespace lamella::render
