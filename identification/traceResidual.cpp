/// From a measured residual to a named effect. See README.md beside this file.
#include "files/wholeFile.h"
#include "procedure/loop.h"
#include "report/html.h"
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

fs::path reportFolder(const Arguments& arguments)
{
    return arguments.folder.empty() ? fs::absolute(arguments.study).parent_path() / "results" : arguments.folder;
}

/// The page of a report whose runs are not stored. A page that is there already may have curves, and stays.
void makeMissingPage(const nlohmann::ordered_json& report, const fs::path& page)
{
    if (fs::exists(page))
    {
        return;
    }
    try
    {
        clepsydra::writeWhole(page, htmlOf(report, std::nullopt));
    }
    catch (const nlohmann::json::exception& error)
    {
        throw std::runtime_error((page.parent_path() / "report.json").string()
                                 + ": another version of traceResidual has written this report, and this one makes no "
                                   "page of it ("
                                 + error.what() + ")");
    }
}

/// What report.json says, for people.
void showReport(const fs::path& folder)
{
    std::ifstream file(folder / "report.json");
    const auto report = nlohmann::ordered_json::parse(file, nullptr, false);
    if (!report.is_object() || !report.contains("summary"))
    {
        throw std::runtime_error((folder / "report.json").string() + (file.is_open() ? ": damaged" : ": not there")
                                 + "; 'traceResidual run' makes it");
    }
    writeText(report, std::cout);
    makeMissingPage(report, folder / "report.html");
    std::cout << "Curves and tables: " << (folder / "report.html").string() << '\n';
}

/// Files of a report again, where the runs are still stored.
void renewReport(const fs::path& study, const fs::path& folder)
{
    try
    {
        reportAgain(study, folder);
    }
    catch (const clepsydra::FileError&)
    {
        throw;
    }
    catch (const std::exception& error)
    {
        std::cerr
            << "report.json stays as it is, and report.html, where it is missing, is made of it without curves: the "
               "report cannot be made again from stored runs: "
            << error.what() << "\n\n";
    }
}

} // namespace

int main(int argc, char** argv)
{
    Arguments arguments;
    CLI::App app("From a measured residual to a named effect: what the model lacks, and the error before and after");
    app.require_subcommand(1);
    auto* drafting = app.add_subcommand("new", "a commented study file for measured files, with places to fill in");
    drafting->add_option("case", arguments.caseFolder, "folder of the simulation's case")
        ->required()
        ->check(CLI::ExistingDirectory);
    drafting->add_option("measured", arguments.measured, "CSV files, or folders of them")
        ->required()
        ->check(CLI::ExistingPath);
    drafting->add_option("--output", arguments.study, "file to make; default: study.yaml here");
    auto* planning =
        app.add_subcommand("plan", "before any data: what is detectable, what hides behind what, the cost");
    planning->add_option("study", arguments.study, "study file (YAML)")->required()->check(CLI::ExistingFile);
    planning->add_flag("--execute", arguments.execute, "make the runs of the effect library");
    planning->add_flag("--time", arguments.time, "where no run has been timed yet, make one, for the cost");
    auto* running = app.add_subcommand("run", "from study file to report; may be interrupted and started again");
    running->add_option("study", arguments.study, "study file (YAML)")->required()->check(CLI::ExistingFile);
    running->add_option("--output", arguments.folder, "folder of the reports; default: results beside the study");
    auto* reporting = app.add_subcommand("report", "the report of a study that has been run, from its stored runs");
    reporting->add_option("study", arguments.study, "study file (YAML)")->required()->check(CLI::ExistingFile);
    reporting->add_option("--output", arguments.folder, "folder of the reports; default: results beside the study");
    CLI11_PARSE(app, argc, argv);

    try
    {
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
            runStudy(arguments.study, reportFolder(arguments), std::cerr);
            showReport(reportFolder(arguments));
        }
        else
        {
            renewReport(arguments.study, reportFolder(arguments));
            showReport(reportFolder(arguments));
        }
        return 0;
    }
    catch (const std::exception& error)
    {
        std::cerr << "traceResidual: " << error.what() << '\n';
        return 1;
    }
}
