#pragma once

#include <cfenv>

namespace clepsydra
{

/// Makes exactly the given floating-point exceptions (FE_INVALID | ...) end the program while the object exists, and
/// restores the previous setting afterwards.
///
/// OpenFOAM lets these exceptions end the program, which then cannot report the particle that caused them. LIGGGHTS
/// continues with "not a number", so the particle can be found.
class FloatingPointTraps
{
public:
    explicit FloatingPointTraps(int exceptions)
        : before_(fegetexcept())
    {
        set(exceptions);
    }

    ~FloatingPointTraps()
    {
        set(before_);
    }

    FloatingPointTraps(const FloatingPointTraps&) = delete;
    FloatingPointTraps& operator=(const FloatingPointTraps&) = delete;

    int before() const
    {
        return before_;
    }

private:
    static void set(int exceptions)
    {
        std::feclearexcept(FE_ALL_EXCEPT);
        fedisableexcept(FE_ALL_EXCEPT & ~exceptions);
        feenableexcept(exceptions);
    }

    int before_;
};

} // namespace clepsydra
