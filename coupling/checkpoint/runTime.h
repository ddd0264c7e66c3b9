#pragma once

#include "Time.H"
#include "argList.H"

namespace clepsydra
{

/// OpenFOAM's Time for a run that may be stopped and resumed at any step.
///
/// Write times are counted from the fresh start, wherever the run was resumed: a run that was stopped between two of them
/// writes the same ones as if it had not been. Function objects are not executed by loop(), which would be after the
/// checkpoint that holds their state, but where the program calls them.
class RunTime : public Foam::Time
{
public:
    explicit RunTime(const Foam::argList& args);

    /// From this time, whatever system/controlDict says of the start. Not even the names of others are looked at.
    RunTime(const Foam::argList& args, const Foam::word& start);

    /// Goes on from the time that a run has written, to the last digit: the sum of the steps, not its name.
    /// \param beginning  time of the fresh start [s]
    void resume(double beginning);

    /// The next step, until the end time.
    bool loop() override;

    /// The same, with a step of this length [s].
    bool loop(double step);

    /// To the next write time, where that is not counted in steps or wall time, or to the end [s]: whichever comes first.
    /// VGREAT where there is neither. At the end the time to the next write time, as if the run went on.
    double timeLeft() const;

    Foam::Time& operator++() override;
    using Foam::Time::operator++;

    /// As Time's, which moves the end away and brings it back with the next step; in the last step there is none, so
    /// that a function object that asks again there is not heard.
    bool stopAt(const stopAtControls control) const override;
    using Foam::Time::stopAt;

    /// Makes this step a write time and the last.
    void endHere();

    /// Makes this step a write time.
    void writeHere();

    /// True if this step is the last.
    bool atEnd() const;

private:
    void requireWholeState() const;
    /// Not by steps or wall time.
    bool writesByTime() const;

    double beginning_;
};

} // namespace clepsydra
