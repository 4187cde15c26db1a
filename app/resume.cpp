#include "resume.h"

#include "scene/keys.h"
#include "usage_error.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace lamella {

namespace {

/// Where a start is stored differs with the folder.
bool is_place(const Key& key) { return key.section == "shape" && key.name == "file"; }

bool is_in(const Key& key, std::span<const std::string_view> sections) {
  return std::ranges::count(sections, key.section) > 0;
}

void forget(SemiImplicit::Memory& memory) { memory.dt = 0; }

} // namespace

std::vector<const Key*> differences(const Scene& a, const Scene& b) {
  std::vector<const Key*> keys;
  for (const Key& key : scene_keys()) {
    const bool in_a = key.counts_in(a), in_b = key.counts_in(b);
    if (is_place(key) || (!in_a && !in_b)) continue;
    if (in_a != in_b || value_text(key, a) != value_text(key, b)) keys.push_back(&key);
  }
  return keys;
}

std::string difference_text(std::span<const Key* const> keys, const Scene& from, const Scene& to) {
  const auto value = [](const Key& key, const Scene& scene) {
    return key.counts_in(scene) ? value_text(key, scene) : "none";
  };
  std::string text;
  for (const Key* key : keys)
    text += fmt::format("{}{}: {} -> {}", text.empty() ? "" : "; ",
                        key->section.empty() ? std::string(key->name) : key->label(),
                        value(*key, from), value(*key, to));
  return text;
}

void refuse_unbranchable(std::span<const Key* const> changed, const Scene& from, const Scene& to) {
  constexpr std::array<std::string_view, 7> fixed{"grid",   "shape", "perturbation",   "domains",
                                                  "volume", "area",  "area_difference"};
  std::vector<const Key*> refused;
  for (const Key* key : changed)
    if (is_in(*key, fixed)) refused.push_back(key);
  if ((from.stretch.modulus > 0) != (to.stretch.modulus > 0))
    refused.push_back(find_key("stretch", "modulus"));
  if (refused.empty()) return;
  throw UsageError(fmt::format("{}: no branch can change that; start a new run from a stored frame "
                               "with shape.kind = \"frame\" instead",
                               difference_text(refused, from, to)));
}

SimulationState branched(SimulationState state, std::span<const Key* const> changed) {
  constexpr std::array<std::string_view, 4> harmless{"", "run", "output", "stop"};
  if (std::ranges::all_of(changed, [&](const Key* key) { return is_in(*key, harmless); }))
    return state;
  forget(state.stepper);
  for (auto& [name, memory] : state.field_steppers) forget(memory);
  std::ranges::fill(state.excess, 0.0);
  state.error = state.last_dt = state.response_dt = 0;
  state.failures = 0;
  state.driven = 1;
  return state;
}

} // namespace lamella
