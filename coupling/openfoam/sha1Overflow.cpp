/// \file
/// OpenFOAM's stream buffer for checksums, with the member that its own one lacks.
///
/// OpenFOAM takes the SHA-1 of a dictionary by printing it into an osha1stream, as it does for every function object. That
/// stream's buffer takes sequences of characters (xsputn), but no single character (overflow). Until version 13,
/// libstdc++ wrote `os << 'c'` as a sequence of one; since version 14 it writes a single character. The stream then fails,
/// and the run ends with "error in IOstream sha1". It is the library at run time that decides: Debian 13 has OpenFOAM v1912
/// and libstdc++ 14, and so has Ubuntu 24.04, although the compiler there is GCC 13.
///
/// The class here has the name and the members of OpenFOAM's. The dynamic linker gives libOpenFOAM the first table of
/// virtual functions of that name: this one, because programs need libcoupling before libOpenFOAM. OpenFOAM's header
/// OSHA1stream.H must not be included in our programs: its table would come first.
///
/// CMakeLists.txt compiles this file where OpenFOAM's header has no overflow.

#include "SHA1.H"

#include <streambuf>

namespace Foam
{

class osha1stream
{
    class sha1buf;
};

class osha1stream::sha1buf : public std::streambuf
{
    // The only member of OpenFOAM's class, too.
    SHA1 sha1_;

protected:
    std::streamsize xsputn(const char* characters, std::streamsize count) override;
    int_type overflow(int_type character) override;
};

/// The first virtual function that is not inline: the compiler puts the table of virtual functions beside it.
std::streamsize osha1stream::sha1buf::xsputn(const char* characters, std::streamsize count)
{
    sha1_.append(characters, static_cast<std::size_t>(count));
    return count;
}

std::streambuf::int_type osha1stream::sha1buf::overflow(int_type character)
{
    if (!traits_type::eq_int_type(character, traits_type::eof()))
    {
        const char single = traits_type::to_char_type(character);
        sha1_.append(&single, 1);
    }
    return traits_type::not_eof(character);
}

} // namespace Foam
