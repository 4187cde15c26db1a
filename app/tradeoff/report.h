#pragma once
#include "tradeoff/sweep.h"

#include <span>
#include <string>

namespace lamella {

/// 64^3, or 64x64x96.
std::string grid_text(const Scene& scene);

/// The table on the screen: its head, and a trial; each ends its line.
std::string table_head();
std::string table_row(const Trial& trial);

/// All trials as tradeoff.csv; what is not known is an empty cell.
std::string tradeoff_csv(std::span<const Trial> trials);

/// All trials as a Markdown page, with the scene, the reference and the machine.
std::string tradeoff_markdown(const Scene& scene, const Reference& reference,
                              std::span<const Trial> trials, int repeats);

} // namespace lamella
