/// Traces a measured residual to a physical effect. See docs/howTo/ownMeasurement.md.
#include "files/standardStreams.h"
#include "files/wholeFile.h"
#include "procedure/loop.h"
#include "report/report.h"
#include "report/text.h"
#include "study/draft/draftStudy.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <vector>

namespace
{

namespace fs = std::filesystem;
using namespace clepsydra::identification;

struct Arguments
{
    fs::path study = "study.yaml";
    fs::path folder;
    fs::path caseFolder;
    std::vector<fs::path> measured;
    bool execute = false;
    bool time = false;
};

/// Prints the results of report.json. Writes the page of a report whose runs are not stored.
void showReport(const fs::path& folder)
{
    const std::string name = (folder / "report.json").string();
    const fs::path page = folder / "report.html";
    std::ifstream file(name);
    const auto report = nlohmann::ordered_json::parse(file, nullptr, false);
    if (!report.is_object() || !report.contains("summary"))
    {
        throw std::runtime_error(
            name + (file.is_open() ? " is damaged" : " does not exist") + "; 'traceResidual run' writes it");
    }
    writeText(report, std::cout);
    try
    {
        // An existing page may have curves and is not overwritten.
        if (!fs::exists(page))
        {
            clepsydra::writeWhole(page, htmlOf(report, std::nullopt));
        }
    }
    catch (const nlohmann::json::exception& error)
    {
        throw std::runtime_error(name
                                 + ": another version of traceResidual has written this report, and this version "
                                   "cannot make a page from it ("
                                 + error.what() + ")");
    }
    std::cout << "Curves and tables: " << page.string() << '\n';
}

/// Writes the files of a report again if all its runs are stored.
void renewReport(const fs::path& study, const fs::path& folder)
{
    try
    {
        std::ostream nowhere(nullptr);
        runStudy(study, folder, nowhere, true);
    }
    catch (const clepsydra::FileError&)
    {
        throw;
    }
    catch (const std::exception& error)
    {
        std::cerr
            << "report.json stays as it is, because the report cannot be made from stored runs; if report.html is "
               "missing, it is made from report.json without curves. The reason: "
            << error.what() << "\n\n";
    }
}

} // namespace

int main(int argc, char** argv)
{
    clepsydra::openClosedStandardStreams();
    Arguments arguments;
    CLI::App app(
        "Traces a measured residual to the physical effect that the model lacks, and reports the error on held-out "
        "conditions before and after that effect is added");
    app.require_subcommand(1);
    auto* drafting =
        app.add_subcommand("new", "draft a commented study file for measured files, with places to fill in");
    drafting->add_option("case", arguments.caseFolder, "case directory of the simulation")
        ->required()
        ->check(CLI::ExistingDirectory);
    drafting->add_option("measured", arguments.measured, "CSV files, or folders that contain them")
        ->required()
        ->check(CLI::ExistingPath);
    drafting->add_option("--output", arguments.study, "file to write; default: study.yaml in the current directory");
    const auto addCommand = [&](const std::string& name, const std::string& purpose) {
        auto* command = app.add_subcommand(name, purpose);
        command->add_option("study", arguments.study, "study file (YAML)")->required()->check(CLI::ExistingFile);
        return command;
    };
    auto* planning =
        addCommand("plan", "before measuring: which effects can be detected and distinguished, and what the runs cost");
    planning->add_flag("--execute", arguments.execute, "make the runs of the effect library");
    planning->add_flag("--time", arguments.time, "make one run to measure its time, if none has been timed yet");
    auto* running = addCommand("run", "process a study and write its report; may be interrupted and started again");
    auto* reporting = addCommand("report", "print the report of a study again, from its stored runs");
    for (auto* command : {running, reporting})
    {
        command->add_option(
            "--output", arguments.folder, "folder of the reports; default: results beside the study file");
    }
    CLI11_PARSE(app, argc, argv);

    try
    {
        const fs::path beside = fs::absolute(arguments.study).parent_path() / "results";
        const fs::path folder = arguments.folder.empty() ? beside : arguments.folder;
        if (*drafting)
        {
            draftStudy(arguments.caseFolder, arguments.measured, arguments.study, std::cout);
        }
        else if (*planning)
        {
            plan(arguments.study, arguments.execute, arguments.time, std::cout);
        }
        else if (*running)
        {
            runStudy(arguments.study, folder, std::cerr);
            showReport(folder);
        }
        else
        {
            renewReport(arguments.study, folder);
            showReport(folder);
        }
        if (!std::cout.flush())
        {
            throw std::runtime_error("standard output could not be written: is the disk full?");
        }
        return 0;
    }
    catch (const std::exception& error)
    {
        std::cerr << "traceResidual: " << error.what() << '\n';
        return 1;
    }
}
