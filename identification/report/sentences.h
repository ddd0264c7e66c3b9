#pragma once

#include "report/report.h"

#include <string>
#include <vector>

namespace clepsydra::identification
{

/// What a report says in words, for readers who do not know the procedure.
struct Sentences
{
    std::string summary; // the answer
    /// Which condition decided, what the parameters alone could do, what would refute the answer, how certain it is, how
    /// well it predicts, and whether the effect may enter the model.
    std::vector<std::string> details;
    std::vector<std::string> next;        // what to measure next, and which result is expected
    std::vector<std::string> assumptions; // behind the answer
};

Sentences sentencesOf(const Findings& findings);

/// Name of the effect or family that was found.
std::string namedBy(const Study& study, const Answer& answer);

} // namespace clepsydra::identification
