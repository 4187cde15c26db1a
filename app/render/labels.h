#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

namespace lamella::render {

/// A number as it is set in print, to `digits` significant digits without trailing zeros: "0.25",
/// "1.6×10⁻³". Powers of ten appear below 0.01 and from 10⁵ on.
std::string number(double value, int digits = 3);

/// "⁻³"
std::string superscript(int value);

/// "10⁻³"
std::string power_of_ten(int exponent);

/// The power of ten that numbers up to `largest` are written without: 0, unless they would be very
/// small or large.
int exponent_of(double largest);

/// "10⁻³ *κ*", what such numbers are in units of.
std::string with_power(int exponent, const std::string& unit);

/// "64³", or "64×64×96"
std::string grid_label(const std::array<int, 3>& nodes);

/// The text in ASCII, for messages and for fonts without Greek and superscripts: "1.6x10^-3".
std::string plain(const std::string& text);

/// Ticks of an axis.
struct Ticks {
  std::vector<double> positions;
  std::vector<std::string> labels; ///< of position / 10^exponent; none: a minor tick
  int exponent = 0;                ///< 0 unless the labels would be very small or large
};

/// What an axis has for the labels of its ticks; lengths are along it.
struct LabelRoom {
  double axis;                                     ///< from end to end
  std::function<double(const std::string&)> label; ///< of a label, with the gap to the next
};

/// Three to eight round positions within [low, high], low < high. Labels are at equal distances, as
/// many as stay apart.
Ticks linear_ticks(double low, double high, const LabelRoom& room);

/// 1, 2 ... 9 times the powers of ten within [10^low, 10^high]. Powers are labelled as far as
/// labels stay apart, 2 and 5 times them too where there are hardly more than two, and others where
/// else there was one label alone.
Ticks log_ticks(double low, double high, const LabelRoom& room);

} // namespace lamella::render
