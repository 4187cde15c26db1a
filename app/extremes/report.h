#pragma once
#include "extremes/verdict.h"

#include <span>
#include <string>

namespace lamella {

/// The table on the screen: its head, and a case; each ends its line.
std::string extremes_head();
std::string extremes_row(const CaseResult& result);

/// "60 cases: 40 right, ..., 0 WRONG"
std::string count_of_verdicts(std::span<const CaseResult> results);

/// All cases as extremes.csv; what is not known is an empty cell.
std::string extremes_csv(std::span<const CaseResult> results);

/// All cases as a Markdown page, with the machine.
std::string extremes_markdown(std::span<const CaseResult> results);

} // namespace lamella
