#pragma once

#include <iostream>

namespace clepsydra
{

/// While it lives, std::cerr prints nothing. LIGGGHTS registers its pair styles for the whole process, and warns there of
/// each that a second instance, or this program, registers again: a hundred lines that mean nothing to the user.
class QuietRegistration
{
public:
    QuietRegistration()
    {
        std::cerr.setstate(std::ios::failbit);
    }

    ~QuietRegistration()
    {
        std::cerr.clear();
    }

    QuietRegistration(const QuietRegistration&) = delete;
    QuietRegistration& operator=(const QuietRegistration&) = delete;
};

} // namespace clepsydra
