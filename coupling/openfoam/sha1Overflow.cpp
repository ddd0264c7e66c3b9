/// \file
/// A replacement of OpenFOAM's stream buffer for checksums that has the missing member overflow().
///
/// OpenFOAM computes the SHA-1 of a dictionary by printing it into an osha1stream, as it does for every function
/// object. The buffer of that stream accepts sequences of characters (xsputn) but no single character (overflow). Until
/// version 13, libstdc++ wrote `os << 'c'` as a sequence of one; since version 14 it writes a single character. The
/// stream then fails, and the run ends with "error in IOstream sha1". The library at run time is decisive: Debian 13
/// has OpenFOAM v1912 and libstdc++ 14, and so has Ubuntu 24.04, although its compiler is GCC 13.
///
/// The class in this file has the name and the members of OpenFOAM's class. The dynamic linker gives libOpenFOAM the
/// first table of virtual functions of that name. That is the one in this file, because programs load libcoupling
/// before libOpenFOAM. OpenFOAM's header OSHA1stream.H must not be included in this project, because the table it
/// creates would come first.
///
/// CMakeLists.txt compiles this file where OpenFOAM's header has no overflow().

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
    // This is also the only member of OpenFOAM's class.
    SHA1 sha1_;

protected:
    std::streamsize xsputn(const char* characters, std::streamsize count) override;
    int_type overflow(int_type character) override;
};

/// The first virtual function that is not inline. The compiler places the table of virtual functions in the same file.
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
