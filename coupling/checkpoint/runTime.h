#pragma once

#include "Time.H"
#include "argList.H"

namespace clepsydra
{

/// OpenFOAM's Time for a run that may be stopped and resumed at any step.
///
/// Write times are counted from the fresh start, also in a resumed run: a run that was stopped between two write times
/// writes at the same times as an uninterrupted one. loop() does not execute function objects, because that would be
/// after the checkpoint that holds their state; the program calls them.
class RunTime : public Foam::Time
{
public:
    explicit RunTime(const Foam::argList& args);

    /// Starts from the given time, whatever system/controlDict says. The names of other time folders are not examined.
    RunTime(const Foam::argList& args, const Foam::word& start);

    /// Restores the time of a checkpoint to the last digit: the value that the run has written, not the name of the
    /// folder.
    /// \param beginning  time of the fresh start [s]
    void resume(double beginning);

    /// Advances to the next step. \return false at the end time
    bool loop() override;

    /// Advances by a step of the given length [s]. \return false at the end time
    bool loop(double step);

    /// Time to the next write time, where that is not counted in steps or wall time, or to the end [s], whichever is
    /// first. VGREAT where there is neither. At the end it is the time to the next write time of a run that continues.
    double timeLeft() const;

    Foam::Time& operator++() override;
    using Foam::Time::operator++;

    /// As Time::stopAt(), except in the last step. Time::stopAt() moves the end time and restores it in the next step,
    /// which the last step does not have, so a second request of a function object there is ignored.
    bool stopAt(const stopAtControls control) const override;
    using Foam::Time::stopAt;

    /// Makes this step a write time and the last step.
    void endHere();

    /// Makes this step a write time.
    void writeHere();

    /// True if this step is the last.
    bool atEnd() const;

protected:
    /// Called when system/controlDict has been edited during the run. Values of purgeWrite and writeCompression with
    /// which no run may start (Checkpoints) are not accepted then either: the run keeps the earlier ones and warns.
    void readDict() override;

private:
    void requireWholeState() const;
    /// Whether write times are given as times, and not as steps or wall time.
    bool writesByTime() const;

    double beginning_;
};

} // namespace clepsydra
