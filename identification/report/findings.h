#pragma once

#include "heldOut/heldOut.h"
#include "nextRuns/nextExperiment.h"
#include "decision/answer.h"

#include <vector>

namespace clepsydra::identification
{

/// All results that a report is written from.
struct Findings
{
    const Study* study = nullptr;
    const Answer* answer = nullptr;
    const HeldOutResult* heldOut = nullptr; // null while the answer is written
    const std::vector<NextExperiment>* next = nullptr;
    const StudySimulator* studySimulator = nullptr;
    const std::vector<MeasuredCondition>* data = nullptr;        // of the training conditions
    const std::vector<MeasuredCondition>* heldOutData = nullptr; // null while the answer is written
};

} // namespace clepsydra::identification
