/// \file
/// The engine replaces functions of LIGGGHTS' library, and says so where a library would not notice.

#include "engine/demEngine.h"
#include "engine/liggghts/replacedFunctions.h"

#include <gtest/gtest.h>

#include <string>

extern "C" int answer()
{
    return 2;
}
extern "C" int ask_usual();
extern "C" int ask_symbolic();

namespace clepsydra::tests
{

namespace
{

template<class Function>
const void* addressOf(Function& function)
{
    return reinterpret_cast<const void*>(&function);
}

std::string complaint(const void* inLibrary, const void* inReplacement)
{
    try
    {
        requireReplaced({"answer"}, inLibrary, inReplacement);
    }
    catch (const DemEngineError& error)
    {
        return error.what();
    }
    return {};
}

} // namespace

/// The same source twice: the library that is linked as usual calls this program's function in the place of its own, and
/// nothing is said. The one that is linked with -Bsymbolic-functions goes on to call its own, and is named. A check that
/// looks at anything but what the library was linked to call finds no difference between the two.
TEST(ReplacedFunctions, AreMissedWhereALibraryCallsItsOwn)
{
    ASSERT_EQ(ask_usual(), 2);
    EXPECT_EQ(complaint(addressOf(ask_usual), addressOf(answer)), "");

    ASSERT_EQ(ask_symbolic(), 1);
    const std::string message = complaint(addressOf(ask_symbolic), addressOf(answer));
    EXPECT_NE(message.find("libsymbolicLibrary.so calls its own answer"), std::string::npos) << message;
    EXPECT_NE(message.find("allowed: a library linked without -Bsymbolic"), std::string::npos) << message;
}

/// A replacement counts only if it is the one that is found: here the program's is, not one of the other library's.
TEST(ReplacedFunctions, AreMissedWhereAnotherObjectComesFirst)
{
    EXPECT_NE(complaint(addressOf(ask_usual), addressOf(ask_symbolic)), "");
}

} // namespace clepsydra::tests
