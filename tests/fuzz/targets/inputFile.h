#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace clepsydra
{

/// The fuzzer's bytes as the file that a reader expects. Relative to the working folder, which scripts/fuzz makes.
inline std::filesystem::path inputFile(const std::filesystem::path& file, const std::uint8_t* data, std::size_t size)
{
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size)); // NOLINT(*-reinterpret-cast)
    return file;
}

inline std::string inputText(const std::uint8_t* data, std::size_t size)
{
    return {data, data + size};
}

} // namespace clepsydra
