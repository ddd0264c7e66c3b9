#pragma once

#include "engine/demEngine.h"

#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace clepsydra
{

/// The files that LIGGGHTS opens to write while this object exists: dumps, tables of fixes, logs.
///
/// LIGGGHTS begins each of them again when its script is executed, and does not look whether a write has succeeded. The
/// C library's fopen() and fclose() are therefore replaced in this program; for calls from LIGGGHTS they lead to this
/// class. One object at a time.
class OutputFiles
{
public:
    /// \param log  LIGGGHTS' log: a resumed run appends to it; it is not checked
    /// \param continued  of the run that is resumed: where LIGGGHTS begins one of these again, it is continued
    OutputFiles(std::string log, std::vector<EngineOutput> continued, bool resumes);
    ~OutputFiles();
    OutputFiles(const OutputFiles&) = delete;
    OutputFiles& operator=(const OutputFiles&) = delete;

    /// Does not continue this file after all, because its writer replaces its contents each time.
    void beginAgain(const std::string& file);

    /// Cuts the continued files to the sizes that they had: what is behind was written after the checkpoint, or is a
    /// heading that LIGGGHTS writes at each start. Call before the first step of a resumed run. \throws FileError
    void cutToCheckpoint();

    /// Flushes what is open. \throws FileError where anything was not written, at any time since the start
    void requireWritten();

    /// The files that are open, but the log. \throws FileError as requireWritten()
    std::vector<EngineOutput> outputs();

    /// In place of fopen() and fclose().
    std::FILE* open(const char* file, const char* mode);
    int close(std::FILE* file);

    /// The object that exists; null where there is none.
    static OutputFiles* current();

private:
    bool isContinued(const std::string& file) const;
    void noteFailure(const std::string& file, int cause);

    const std::string log_;
    const bool resumes_;
    std::vector<EngineOutput> continued_;
    std::map<std::FILE*, std::string> open_;
    std::string failure_;
};

} // namespace clepsydra
