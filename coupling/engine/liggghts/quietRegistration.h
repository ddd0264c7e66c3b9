#pragma once

#include <iostream>

namespace clepsydra
{

/// Suppresses the output of std::cerr while the object exists. LIGGGHTS registers its pair styles for the whole
/// process, and warns of each that a second instance or this program registers again: a hundred lines without
/// information for the user.
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
