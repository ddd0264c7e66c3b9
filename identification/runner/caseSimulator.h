#pragma once

#include "runner/executor.h"
#include "runner/simulator.h"
#include "study/study.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <set>
#include <string>

namespace clepsydra::identification
{

/// A case directory and its command. A run is a copy of the directory with other entries; what it has written is kept
/// under a key of everything that entered it, and never computed twice:
///
///     work/cache/<key>/    entries, observable, and how it went, with checksums: what is damaged is made again, and what
///                          failed, unless the study's budget is 0
///     work/tree/<...>      copies while they run; those that failed stay for people to look at
///
/// Relative paths that lead out of the case (../../scripts) work in a copy as well: the folders round it are mirrored
/// with links.
class CaseSimulator final : public Simulator
{
public:
    /// \param progress  is reported how far the runs are
    CaseSimulator(const Study& study, std::ostream& progress);

    Entries defaults() const override;
    std::vector<RunResult> run(const std::vector<RunOrder>& orders) override;
    int missing(const std::vector<RunOrder>& orders) override;

    /// Hash of all that enters a run.
    std::string keyOf(const RunOrder& order) const;

    /// Mean wall-clock seconds of the stored runs; nothing where there are none.
    std::optional<double> measuredSecondsPerRun() const;

    /// The same, or the study's own estimate.
    double secondsPerRun() const
    {
        return measuredSecondsPerRun().value_or(study_.simulator.costPerRun);
    }

private:
    std::filesystem::path copyOf(const std::string& key) const;
    void prepare(const RunOrder& order, const std::filesystem::path& folder) const;
    bool load(const RunOrder& order, const std::filesystem::path& stored, RunResult& result) const;
    /// \param failures  by pattern of files that are wanted; empty: there they are
    void store(const RunOrder& order, const std::map<std::string, std::string>& failures,
        const std::filesystem::path& folder, const std::filesystem::path& stored, double seconds) const;
    void mirrorSurroundings() const;

    const Study& study_;
    std::filesystem::path caseFolder_;
    std::filesystem::path cache_;
    std::filesystem::path tree_;
    std::string fingerprint_; // of the case's files, what it depends on, and the version
    std::unique_ptr<Executor> executor_;
    std::ostream& progress_;
    mutable std::set<std::filesystem::path> damaged_; // stored runs that people have been reported
};

} // namespace clepsydra::identification
