#pragma once
#include "dynamics/measures.h"

#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lamella {

struct Scene;

/// What the numbers of a run should be; NaN where that is not known.
struct ReferenceState {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double time = std::numeric_limits<double>::infinity(); ///< infinite: at rest
  double energy = unknown, int_KM2 = unknown, P = unknown, sigma = unknown;

  /// Of a column of history.csv, also of an energy that is bending alone.
  double value(std::string_view column) const;
};

/// An exact or much finer solution that runs are compared with: states over time, or one at rest.
class Reference {
public:
  /// A table as in data/reference: a line of column names, then rows of numbers, separated by
  /// commas. Of its columns count t, energy (or E), int_KM2 (or intKM2), P and sigma; without t it
  /// is one state at rest. history.csv is such a table. Throws SceneError, with `source` for the
  /// file.
  Reference(std::string_view table, std::string source);
  /// The run itself, in the order of time.
  Reference(std::span<const Measures> history, std::string source);

  const std::string& source() const { return source_; }
  bool at_rest() const { return states_.size() == 1; }
  bool covers(double time) const { return time <= states_.back().time * (1 + 1e-9); }
  /// A time that is covered; between two states linear in the logarithm of time.
  ReferenceState at(double time) const;

private:
  std::vector<ReferenceState> states_;
  std::string source_;
};

/// Throws StoreError, SceneError.
Reference read_reference(const std::filesystem::path& file);

/// The exact solution of a built-in scene, where one is compiled in that covers its end, and the
/// scene differs from the built-in one in title, grid, numerics, output and end alone. A state at
/// rest is not for runs that end before the built-in one does.
std::optional<Reference> builtin_reference(const Scene& scene);

/// Relative errors; NaN where the reference knows no value.
struct Errors {
  double course =
      ReferenceState::unknown; ///< energy: mean over the logarithm of time, end/100 to end
  double energy = ReferenceState::unknown, P = ReferenceState::unknown,
         sigma = ReferenceState::unknown; ///< at the end

  /// The largest of them: no number that was compared is worse.
  double largest() const;
};

/// `history` from the start to the end of a run, at least two states.
Errors compare(std::span<const Measures> history, const Reference& reference);

} // namespace lamella
