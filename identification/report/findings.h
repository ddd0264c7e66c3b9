#pragma once

#include "heldOut/heldOut.h"
#include "nextRuns/nextExperiment.h"
#include "procedure/answer.h"

#include <vector>

namespace clepsydra::identification
{

/// Everything that is known when a report is written.
struct Findings
{
    const Study* study = nullptr;
    const Answer* answer = nullptr;
    const HeldOutResult* heldOut = nullptr; // not there before the answer is written
    const std::vector<NextExperiment>* next = nullptr;
    const StudySimulator* studySimulator = nullptr;
    const std::vector<MeasuredCondition>* data = nullptr;        // of training conditions
    const std::vector<MeasuredCondition>* heldOutData = nullptr; // not there before the answer is written
};

} // namespace clepsydra::identification
