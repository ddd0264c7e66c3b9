#include "files/fileSystemProbe.h"

#include "files/wholeFile.h"

#include <fstream>

namespace clepsydra
{

namespace
{

const std::string text = "Written at the start of a run, to see whether a checkpoint could be written here.\n";

void tryOnce(const std::filesystem::path& file)
{
    FileThroughPipe written(file);
    {
        std::ofstream library(FileThroughPipe::entrance(file));
        library << text;
        if (!library.flush())
        {
            throw FileError("Cannot write through the link " + FileThroughPipe::entrance(file).string());
        }
    }
    written.finish();
    if (contentsOf(file).sha256 != sha256(text))
    {
        throw FileError(file.string() + " does not contain what was written to it");
    }
}

} // namespace

void probeFileSystem(const std::filesystem::path& folder, const std::string& name)
{
    const std::filesystem::path file = folder / name;
    std::error_code ignored;
    try
    {
        tryOnce(file);
    }
    catch (const FileError& error)
    {
        std::filesystem::remove(file, ignored);
        throw FileError("The folder " + folder.string() + " cannot hold a checkpoint: " + error.what()
                        + "; allowed: a file system that has room, symbolic links, fsync and rename, and a system "
                          "with /proc");
    }
    std::filesystem::remove(file, ignored);
}

} // namespace clepsydra
