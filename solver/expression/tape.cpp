#include "expression/tape.h"

#include <algorithm>

namespace lamella {
namespace {

/// The last step that needs each value; that behind the last one for results.
std::vector<std::size_t> last_uses(int variables, std::span<const Tape::Step> steps,
                                   std::span<const int> results) {
  std::vector<std::size_t> last(static_cast<std::size_t>(variables) + steps.size(), 0);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    last[static_cast<std::size_t>(steps[i].left)] = i;
    last[static_cast<std::size_t>(steps[i].right)] = i;
  }
  for (const int result : results) last[static_cast<std::size_t>(result)] = steps.size();
  return last;
}

} // namespace

Tape::Tape(int variables, std::vector<Step> steps, std::vector<int> results)
    : variables_(variables), steps_(std::move(steps)), results_(std::move(results)) {
  const auto last = last_uses(variables, steps_, results_);
  std::vector<int> place(last.size()), unused;
  for (int v = 0; v < variables; ++v) place[static_cast<std::size_t>(v)] = v;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    Step& step = steps_[i];
    const std::size_t left = static_cast<std::size_t>(step.left),
                      right = static_cast<std::size_t>(step.right);
    for (const std::size_t value : {std::min(left, right), std::max(left, right)})
      if (place[value] >= variables && last[value] == i &&
          std::ranges::find(unused, place[value]) == unused.end())
        unused.push_back(place[value]);
    if (unused.empty()) unused.push_back(variables + registers_++);
    step.left = place[left];
    step.right = place[right];
    targets_.push_back(unused.back() - variables);
    place[static_cast<std::size_t>(variables) + i] = unused.back();
    unused.pop_back();
  }
  for (int& result : results_) result = place[static_cast<std::size_t>(result)];
}

} // namespace lamella
