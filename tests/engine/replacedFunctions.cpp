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
extern "C" int short_answer()
{
    return 2;
}
extern "C" int of_the_program_only()
{
    return 2;
}
extern "C" int ask_usual();
extern "C" int ask_symbolic();
extern "C" int ask_short_usual();
extern "C" int ask_short_symbolic();

namespace clepsydra::tests
{

namespace
{

template<class Function>
const void* addressOf(Function& function)
{
    return reinterpret_cast<const void*>(&function);
}

std::string complaint(const std::string& symbol, const void* inLibrary, const void* inReplacement)
{
    try
    {
        replaceFunctions({symbol}, inLibrary, inReplacement);
    }
    catch (const DemEngineError& error)
    {
        return error.what();
    }
    return {};
}

} // namespace

/// The same source twice: the library that is linked as usual calls this program's function in the place of its own
/// without our doing. The one that is linked with -Bsymbolic-functions calls its own, as Ubuntu's LIGGGHTS does, until
/// its function is replaced, and then this program's; twice is as good as once. Where nothing is done, it goes on with
/// its own; where the linking is not looked at, the function of a library that is in order is overwritten, too.
TEST(ReplacedFunctions, AreCalledHoweverTheLibraryIsLinked)
{
    ASSERT_EQ(ask_usual(), 2);
    EXPECT_EQ(complaint("answer", addressOf(ask_usual), addressOf(answer)), "");
    EXPECT_EQ(ask_usual(), 2);

    ASSERT_EQ(ask_symbolic(), 1);
    EXPECT_EQ(complaint("answer", addressOf(ask_symbolic), addressOf(answer)), "");
    EXPECT_EQ(ask_symbolic(), 2);
    EXPECT_EQ(complaint("answer", addressOf(ask_symbolic), addressOf(answer)), "");
    EXPECT_EQ(ask_symbolic(), 2);
}

/// A function that is too short for a jump stays as it is, for what follows it in memory is another one; library and
/// function are named, with what to do. A jump that is written all the same destroys the function behind it.
TEST(ReplacedFunctions, AreMissedWhereALibraryCallsItsOwnShortOne)
{
    ASSERT_EQ(ask_short_usual(), 2);
    EXPECT_EQ(complaint("short_answer", addressOf(ask_short_usual), addressOf(short_answer)), "");

    ASSERT_EQ(ask_short_symbolic(), 1);
    const std::string message = complaint("short_answer", addressOf(ask_short_symbolic), addressOf(short_answer));
    EXPECT_NE(message.find("libsymbolicLibrary.so calls its own short_answer"), std::string::npos) << message;
    EXPECT_NE(message.find("bytes, and a jump to another function takes"), std::string::npos) << message;
    EXPECT_NE(message.find("allowed: LIGGGHTS linked without -Bsymbolic"), std::string::npos) << message;
    EXPECT_NE(message.find("DEB_LDFLAGS_STRIP=-Wl,-Bsymbolic-functions"), std::string::npos) << message;
    EXPECT_EQ(ask_short_symbolic(), 1);
}

/// A replacement counts only if it is the one that is found: here the program's is, not one of the other library's.
TEST(ReplacedFunctions, AreMissedWhereAnotherObjectComesFirst)
{
    const std::string message = complaint("answer", addressOf(ask_usual), addressOf(ask_symbolic));
    EXPECT_NE(message.find("a third library has a function of this name"), std::string::npos) << message;
}

/// What a library does not have was not replaced; a member that a later LIGGGHTS calls otherwise would go unnoticed.
TEST(ReplacedFunctions, AreMissedWhereTheLibraryHasNone)
{
    const std::string message = complaint("of_the_program_only", addressOf(ask_usual), addressOf(answer));
    EXPECT_NE(message.find("has no function of_the_program_only"), std::string::npos) << message;
}

} // namespace clepsydra::tests
