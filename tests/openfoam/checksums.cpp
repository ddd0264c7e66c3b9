/// \file
/// Checksums of dictionaries, which OpenFOAM takes of every function object.

#include "IStringStream.H"
#include "SHA1.H"
#include "dictionary.H"

#include <gtest/gtest.h>

#include <dlfcn.h>

#include <cstdio>
#include <streambuf>
#include <string>

namespace clepsydra::tests
{

namespace
{

/// osha1stream::sha1buf::overflow(int).
constexpr const char* overflowOfBuffer = "_ZN4Foam11osha1stream7sha1buf8overflowEi";

/// The file that the dynamic linker takes a symbol from; empty where there is none.
std::string originOf(const char* symbol)
{
    Dl_info info{};
    const void* const address = dlsym(RTLD_DEFAULT, symbol);
    return address != nullptr && dladdr(address, &info) != 0 ? info.dli_fname : "";
}

} // namespace

/// The checksum that libOpenFOAM takes of a dictionary depends on all of its text. With libstdc++ 14 and OpenFOAM v1912 it
/// ends with "error in IOstream sha1" where the stream's buffer does not take single characters, or is that of no text.
TEST(Checksums, DependOnTheText)
{
    const auto checksum = [](const std::string& content) {
        Foam::IStringStream text(content);
        return Foam::dictionary(text).digest().str();
    };
    const std::string one = "type probes; fields (U p); more { a b; c \"d e\"; }";
    EXPECT_EQ(checksum(one), checksum(one));
    EXPECT_NE(checksum(one), checksum("type probes; fields (U p); more { a b; c \"d f\"; }"));
    EXPECT_NE(checksum(one), Foam::SHA1(std::string()).digest().str());
}

/// Single characters are part of the text: those of "abc" give the SHA-1 that FIPS 180 has as its first example. The buffer's
/// member is called as libstdc++ 14 does for `os << 'c'`, on systems too whose library does not. One that takes the
/// characters and forgets them has the checksum of no text.
TEST(Checksums, CountSingleCharacters)
{
    // As OpenFOAM's class, which no program but libOpenFOAM can make: see coupling/openfoam/sha1Overflow.cpp.
    struct Buffer : std::streambuf
    {
        Foam::SHA1 sha1;
    };
    const auto overflow = reinterpret_cast<int (*)(std::streambuf*, int)>(dlsym(RTLD_DEFAULT, overflowOfBuffer));
    ASSERT_NE(overflow, nullptr);
    Buffer buffer;
    for (const char character : {'a', 'b', 'c'})
    {
        EXPECT_EQ(overflow(&buffer, character), character);
    }
    EXPECT_NE(overflow(&buffer, EOF), EOF);
    EXPECT_EQ(buffer.sha1.digest().str(), "a9993e364706816aba3e25717850c26c9cd0d89d");
}

/// libOpenFOAM uses the buffer that takes single characters, on systems too where libstdc++ does not yet need it: the
/// linker finds the table of virtual functions in the object that has this member. Where libOpenFOAM comes first, its
/// table does, which in v1912 lacks it.
TEST(Checksums, TakeSingleCharacters)
{
    const std::string origin = originOf(overflowOfBuffer);
    EXPECT_NE(origin, "");
    EXPECT_EQ(originOf("_ZTVN4Foam11osha1stream7sha1bufE"), origin);
}

} // namespace clepsydra::tests
