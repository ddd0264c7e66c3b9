#pragma once

#include "runner/simulator.h"
#include "study/study.h"

#include <filesystem>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <string>

namespace clepsydra::identification
{

/// A case directory and its command. Each run is a copy of the directory with other entries. Its output is stored under
/// a hash of everything that it depends on, so that no run is computed twice:
///
///     work/cache/<key>/  entries, observable and outcome of a run, with checksums. Damaged runs are repeated, and so
///                        are failed ones unless the study's budget is 0
///     work/tree/<...>    the copies while they run; copies of failed runs are kept for inspection
///
/// Relative paths that lead out of the case (../../scripts) work in a copy too, because the folders around the case are
/// mirrored with links.
class CaseSimulator final : public Simulator
{
public:
    /// \param progress  stream that the progress of the runs is written to
    CaseSimulator(const Study& study, std::ostream& progress);

    Entries defaults() const override;
    std::vector<RunResult> run(const std::vector<RunOrder>& orders) override;
    int missing(const std::vector<RunOrder>& orders) override;

    /// Hash of everything that a run depends on.
    std::string keyOf(const RunOrder& order) const;

    /// Mean wall-clock time of the stored runs [s]; empty if there are none.
    std::optional<double> measuredSecondsPerRun() const;

private:
    std::filesystem::path copyOf(const RunOrder& order) const;
    void prepare(const RunOrder& order) const;
    std::optional<RunResult> load(const RunOrder& order);
    /// \param failures  by pattern of the files to store; an empty text means that the files exist
    void store(const RunOrder& order, const std::map<std::string, std::string>& failures,
        const std::filesystem::path& folder, double seconds) const;

    const Study& study_;
    std::filesystem::path caseFolder_;
    std::filesystem::path cache_;
    std::filesystem::path tree_;
    std::string fingerprint_; // hash of the case's files, and of its dependencies
    std::ostream& progress_;
    std::set<std::filesystem::path> damaged_; // damaged runs that have been reported
    std::set<std::filesystem::path> madeNow_; // by this program, which does not repeat those that have failed
};

/// Seconds as hours, minutes and seconds: "00:03:48".
std::string clockTime(double seconds);

} // namespace clepsydra::identification
