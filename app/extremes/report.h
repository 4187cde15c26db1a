#pragma once
#include "extremes/laws.h"
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

/// Of a random scene: a line for a person, and one more for each law that it broke.
std::string law_text(const LawReport& report);
/// The first line of random.csv, and a row.
std::string law_columns();
std::string law_row(const LawReport& report);

} // namespace lamella
