#pragma once

#include "OSspecific.H"
#include "Pstream.H"
#include "Time.H"
#include "dictionary.H"
#include "fileName.H"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

namespace clepsydra::tests
{

/// For tests that use OpenFOAM in the test program itself: a Time in a case without a mesh, in a temporary folder that
/// lives as long as this and that all ranks share. (TestCase, by contrast, runs programs.)
class TemporaryCase
{
public:
    /// Collective. \param controlDict  entries beside the usual ones, which they replace; for instance a `functions`
    ///                                 dictionary
    explicit TemporaryCase(const std::string& controlDict = "")
    {
        using namespace Foam;

        string shared;
        if (Pstream::master())
        {
            std::string pattern = (std::filesystem::temp_directory_path() / "clepsydraTest.XXXXXX").string();
            const std::string folder = mkdtemp(pattern.data());
            shared = folder;
            write(folder, "system/controlDict",
                "startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 0.01; writeControl timeStep; "
                "writeInterval 1000; runTimeModifiable no;\n"
                    + controlDict);
            write(folder, "system/fvSchemes",
                "ddtSchemes { default Euler; } gradSchemes { default Gauss linear; }\n"
                "divSchemes { default Gauss linear; } laplacianSchemes { default Gauss linear corrected; }\n"
                "interpolationSchemes { default linear; } snGradSchemes { default corrected; }\n");
            write(folder, "system/fvSolution",
                "solvers { \".*\" { solver PBiCGStab; preconditioner DIC; tolerance 1e-12; relTol 0; } }\n");
            for (label rank = 0; Pstream::parRun() && rank < Pstream::nProcs(); ++rank)
            {
                std::filesystem::create_directories(
                    std::filesystem::path(folder) / ("processor" + std::to_string(rank)));
            }
        }
        Pstream::scatter(shared);
        folder_ = shared;
        newTime();
    }

    ~TemporaryCase()
    {
        time_.reset();
        waitForAll();
        if (Foam::Pstream::master())
        {
            std::error_code ignored;
            std::filesystem::remove_all(std::string(folder_), ignored);
        }
    }

    TemporaryCase(const TemporaryCase&) = delete;
    TemporaryCase& operator=(const TemporaryCase&) = delete;

    Foam::Time& time()
    {
        return *time_;
    }

    const Foam::Time& time() const
    {
        return *time_;
    }

    /// The case as a whole.
    std::filesystem::path folder() const
    {
        return std::string(folder_);
    }

    /// Starts a new run in this case, with this system/controlDict. Collective.
    /// \pre  whatever refers to the old Time is gone.
    void restart(const std::string& controlDict)
    {
        time_.reset();
        waitForAll();
        if (Foam::Pstream::master())
        {
            write(folder_, "system/controlDict", controlDict);
        }
        waitForAll();
        newTime();
    }

    /// Writes a dictionary file, header and all. Local. \param path  relative to the case
    void writeDictionary(const std::string& path, const std::string& entries) const
    {
        write(folder_, path, entries);
    }

private:
    static void write(const std::string& folder, const std::string& path, const std::string& entries)
    {
        const std::filesystem::path file = std::filesystem::path(folder) / path;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file) << "FoamFile { version 2.0; format ascii; class dictionary; object "
                            << file.filename().string() << "; }\n"
                            << entries << '\n';
    }

    static void waitForAll()
    {
        bool ready = true;
        Foam::reduce(ready, Foam::andOp<bool>());
    }

    void newTime()
    {
        using namespace Foam;
        const word caseName = folder_.name();
        const fileName ownPart =
            Pstream::parRun() ? caseName / ("processor" + Foam::name(Pstream::myProcNo())) : fileName(caseName);
        time_ = std::make_unique<Time>(Time::controlDictName, folder_.path(), ownPart);
    }

    Foam::fileName folder_;
    std::unique_ptr<Foam::Time> time_;
};

} // namespace clepsydra::tests
