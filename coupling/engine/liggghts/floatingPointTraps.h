#pragma once

#include <cfenv>

namespace clepsydra
{

/// While it lives, exactly these floating-point exceptions (FE_INVALID | ...) end the program; afterwards those as before.
///
/// OpenFOAM lets them end the program, which then cannot say which particle it was. LIGGGHTS goes on with "not a number".
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
