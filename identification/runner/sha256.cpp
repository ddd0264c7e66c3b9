#include "runner/sha256.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace clepsydra::identification
{

namespace
{

using Word = std::uint32_t;

constexpr std::size_t blockSize = 64;

// First 32 bits of the fractional parts of the cube roots of the first 64 primes.
constexpr std::array<Word, 64> roundConstants = {0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1,
    0x923f82a4, 0xab1c5ed5, 0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7,
    0xc19bf174, 0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967, 0x27b70a85,
    0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85, 0xa2bfe8a1, 0xa81a664b,
    0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070, 0x19a4c116, 0x1e376c08, 0x2748774c,
    0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3, 0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208,
    0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

Word turned(Word x, unsigned by)
{
    return (x >> by) | (x << (32U - by));
}

void digest(std::array<Word, 8>& state, const unsigned char* block)
{
    std::array<Word, 64> w{};
    for (std::size_t i = 0; i < 16; ++i)
    {
        w[i] = (Word{block[4 * i]} << 24U) | (Word{block[4 * i + 1]} << 16U) | (Word{block[4 * i + 2]} << 8U)
               | Word{block[4 * i + 3]};
    }
    for (std::size_t i = 16; i < 64; ++i)
    {
        const Word s0 = turned(w[i - 15], 7) ^ turned(w[i - 15], 18) ^ (w[i - 15] >> 3U);
        const Word s1 = turned(w[i - 2], 17) ^ turned(w[i - 2], 19) ^ (w[i - 2] >> 10U);
        w[i] = w[i - 16] + s0 + w[i - 7] + s1;
    }
    auto [a, b, c, d, e, f, g, h] = state;
    for (std::size_t i = 0; i < 64; ++i)
    {
        const Word s1 = turned(e, 6) ^ turned(e, 11) ^ turned(e, 25);
        const Word t1 = h + s1 + ((e & f) ^ (~e & g)) + roundConstants[i] + w[i];
        const Word s0 = turned(a, 2) ^ turned(a, 13) ^ turned(a, 22);
        const Word t2 = s0 + ((a & b) ^ (a & c) ^ (b & c));
        h = g;
        g = f;
        f = e;
        e = d + t1;
        d = c;
        c = b;
        b = a;
        a = t1 + t2;
    }
    const std::array<Word, 8> change = {a, b, c, d, e, f, g, h};
    std::transform(state.begin(), state.end(), change.begin(), state.begin(), std::plus<>());
}

std::string contentOf(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    if (!in)
    {
        throw std::runtime_error(file.string() + ": cannot be read");
    }
    std::ostringstream content;
    content << in.rdbuf();
    return content.str();
}

} // namespace

std::string sha256(std::string_view bytes)
{
    // Square roots of the first eight primes.
    std::array<Word, 8> state = {
        0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    std::vector<unsigned char> padded(bytes.begin(), bytes.end());
    padded.push_back(0x80);
    while (padded.size() % blockSize != blockSize - 8)
    {
        padded.push_back(0);
    }
    const std::uint64_t bits = 8 * static_cast<std::uint64_t>(bytes.size());
    for (unsigned shift = 64; shift > 0; shift -= 8)
    {
        padded.push_back(static_cast<unsigned char>(bits >> (shift - 8)));
    }
    for (std::size_t block = 0; block < padded.size(); block += blockSize)
    {
        digest(state, &padded[block]);
    }
    std::ostringstream text;
    text << std::hex << std::setfill('0');
    for (const Word word : state)
    {
        text << std::setw(8) << word;
    }
    return text.str();
}

std::string sha256OfPath(const std::filesystem::path& path, const std::string& leaveOut)
{
    namespace fs = std::filesystem;
    if (!fs::is_directory(path))
    {
        return sha256(contentOf(path));
    }
    std::vector<std::string> lines;
    for (auto entry = fs::recursive_directory_iterator(path); entry != fs::recursive_directory_iterator(); ++entry)
    {
        const auto name = entry->path().filename().string();
        if (!leaveOut.empty() && name == leaveOut)
        {
            entry.disable_recursion_pending();
            continue;
        }
        const std::string place = fs::relative(entry->path(), path).string();
        if (entry->is_symlink())
        {
            lines.push_back(place + " -> " + fs::read_symlink(entry->path()).string());
        }
        else if (entry->is_regular_file())
        {
            lines.push_back(place + ' ' + sha256(contentOf(entry->path())));
        }
    }
    std::sort(lines.begin(), lines.end());
    std::string all;
    for (const auto& line : lines)
    {
        all += line + '\n';
    }
    return sha256(all);
}

} // namespace clepsydra::identification
