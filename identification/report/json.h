#pragma once

#include "heldOut/heldOut.h"
#include "identifiability/identifiability.h"
#include "nextExperiment/nextExperiment.h"
#include "procedure/answer.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Everything that is known when a report is written.
struct Findings
{
    const Study* study = nullptr;
    const EffectLibrary* library = nullptr;
    const Answer* answer = nullptr;
    const HeldOutResult* heldOut = nullptr; // not there before the answer is written
    const std::vector<NextExperiment>* next = nullptr;
    const Simulator* simulator = nullptr;
    const std::vector<MeasuredCondition>* data = nullptr;
};

/// report.json: keys are described in README.md.
nlohmann::ordered_json jsonOf(const Findings& findings);

/// What the report takes for granted, in sentences.
std::vector<std::string> assumptionsOf(const Findings& findings);

} // namespace clepsydra::identification
