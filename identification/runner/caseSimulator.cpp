#include "runner/caseSimulator.h"

#include "curves/table.h"
#include "lists.h"
#include "runner/jobs.h"
#include "runner/storedFiles.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <iomanip>
#include <map>
#include <numeric>
#include <regex>
#include <sstream>

namespace clepsydra::identification
{

namespace
{

namespace fs = std::filesystem;

constexpr const char* recordFile = "record.json";
constexpr std::size_t keyDigits = 20;
constexpr std::ptrdiff_t linesOfLog = 12;

/// With less free space on a disk than this, a file written there may be incomplete [bytes].
constexpr std::uintmax_t leastRoom = 256 * 1024;

/// The last lines of a log.
std::string endOfLog(const fs::path& file)
{
    std::ifstream lines(file);
    std::deque<std::string> last;
    for (std::string line; std::getline(lines, line);)
    {
        last.push_back("\n    " + line);
        last.erase(last.begin(), last.end() - std::min<std::ptrdiff_t>(last.size(), linesOfLog));
    }
    // Bytes that are no UTF-8 are replaced: programs write what they like into their logs.
    using nlohmann::json;
    const json text = std::accumulate(last.begin(), last.end(), std::string());
    return json::parse(text.dump(-1, ' ', false, json::error_handler_t::replace));
}

/// Whether a file of the case is a result of an earlier run. Time directories after the start count as results, because
/// a run that found them would resume from them.
bool isOutput(const std::string& name)
{
    static const std::regex outputs(
        R"(steps|runs|results|postProcessing|VTK|checkpoints|log\..*|processor\d+|.*\.work)");
    char* end = nullptr;
    return std::regex_match(name, outputs) || (std::strtod(name.c_str(), &end) > 0.0 && *end == '\0');
}

std::string fingerprintOf(const Study& study, const fs::path& caseFolder)
{
    std::string all = "\n"; // Without it, runs that are stored already would get other keys.
    std::set<fs::path> names;
    for (const auto& entry : fs::directory_iterator(caseFolder))
    {
        std::error_code dangles;
        if (!isOutput(entry.path().filename().string()) && !fs::equivalent(entry.path(), study.file, dangles))
        {
            names.insert(entry.path());
        }
    }
    for (const auto& path : names)
    {
        all += path.filename().string() + ' ' + sha256OfPath(path, "polyMesh") + '\n';
    }
    for (const auto& path : study.simulator.dependsOn)
    {
        all += sha256OfPath(path) + '\n';
    }
    return sha256(all);
}

/// Checksum over all other fields of a record, by which a damaged record is recognised.
std::string checksumOf(nlohmann::json record)
{
    record.erase("checksum");
    return sha256(record.dump());
}

/// The record of a stored run; null if there is none or if it is damaged.
nlohmann::json readRecord(const fs::path& stored)
{
    std::ifstream file(stored / recordFile);
    auto record = nlohmann::json::parse(file, nullptr, false);
    const bool whole = record.is_object() && record.value("checksum", nlohmann::json()) == checksumOf(record);
    return whole ? record : nlohmann::json();
}

/// Name of the first file of a stored run that is missing or damaged; empty if there is none.
std::string damageOf(const fs::path& stored, const nlohmann::json& record)
{
    if (record.is_null() || record.at("key") != stored.filename().string())
    {
        return recordFile;
    }
    for (const auto& [name, checksum] : record.at("files").items())
    {
        const fs::path file = stored / name;
        if (!fs::is_regular_file(file) || sha256OfPath(file) != checksum)
        {
            return name;
        }
    }
    return "";
}

/// Links to all entries of a folder but one. A link that points elsewhere is replaced, because the store may come from
/// another checkout.
void linkEntries(const fs::path& from, const fs::path& to, const fs::path& butNot)
{
    fs::create_directories(to);
    for (const auto& entry : fs::directory_iterator(from, fs::directory_options::skip_permission_denied))
    {
        const fs::path& target = entry.path();
        const fs::path place = to / target.filename();
        std::error_code ignored;
        if (target.filename() == butNot)
        {
            continue;
        }
        if (fs::is_symlink(place, ignored) && fs::read_symlink(place, ignored) != target)
        {
            fs::remove(place, ignored);
        }
        fs::create_symlink(target, place, ignored);
    }
}

/// Writes one line per finished run with the number of runs and the remaining time.
class Progress
{
public:
    /// \param secondsPerRun  first estimate of the wall-clock time of a run [s]
    Progress(std::ostream& out, std::size_t runs, int atOnce, double secondsPerRun)
        : out_(out),
          runs_(runs)
    {
        const double rounds = std::ceil(static_cast<double>(runs) / atOnce);
        out_ << runs << (runs == 1 ? " run" : " runs") << ", " << atOnce << " at a time, about "
             << clockTime(rounds * secondsPerRun) << std::endl;
    }

    void ended(const std::string& purpose, const std::string& failure)
    {
        ++done_;
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - since_).count();
        const double left = seconds / static_cast<double>(done_) * static_cast<double>(runs_ - done_);
        // The lines that follow are the end of the run's log, which the report has.
        const std::string reason = failure.substr(0, failure.find('\n'));
        out_ << "  " << done_ << '/' << runs_ << ' ' << purpose << (reason.empty() ? "" : " FAILED: " + reason) << ", "
             << clockTime(left) << " to go" << std::endl;
    }

private:
    std::ostream& out_;
    std::size_t runs_;
    std::size_t done_ = 0;
    std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
};

} // namespace

std::string clockTime(double seconds)
{
    const long all = std::lround(std::max(0.0, seconds));
    std::ostringstream text;
    text << std::setfill('0') << std::setw(2) << all / 3600 << ':' << std::setw(2) << all / 60 % 60 << ':'
         << std::setw(2) << all % 60;
    return text.str();
}

CaseSimulator::CaseSimulator(const Study& study, std::ostream& progress)
    : study_(study),
      caseFolder_(fs::canonical(study.simulator.caseFolder)),
      cache_(study.work / "cache"),
      tree_(study.work / "tree"),
      fingerprint_(fingerprintOf(study, caseFolder_)),
      progress_(progress)
{
    std::error_code reason;
    fs::create_directories(cache_, reason);
    if (reason)
    {
        throw FileError("The folder of stored runs cannot be made: " + cache_.string() + ": " + reason.message()
                        + ". The entry `work` of the study names another one.");
    }
    if (!fs::exists(study.work / ".gitignore"))
    {
        std::ofstream(study.work / ".gitignore") << "*\n";
    }
    const fs::path above = caseFolder_.parent_path();
    linkEntries(above.parent_path(), tree_, above.filename());
    linkEntries(above, tree_ / above.filename(), caseFolder_.filename());
}

fs::path CaseSimulator::copyOf(const RunOrder& order) const
{
    return tree_ / caseFolder_.parent_path().filename() / (caseFolder_.filename().string() + '.' + keyOf(order));
}

Entries CaseSimulator::defaults() const
{
    return readEntries(caseFolder_ / entriesFile);
}

std::string CaseSimulator::keyOf(const RunOrder& order) const
{
    std::string all = fingerprint_ + '\n' + order.command + '\n';
    for (const auto& [name, value] : order.entries)
    {
        all += name + ' ' + value + '\n';
    }
    return sha256(all).substr(0, keyDigits);
}

std::optional<RunResult> CaseSimulator::load(const RunOrder& order)
{
    const fs::path stored = cache_ / keyOf(order);
    if (!fs::exists(stored))
    {
        return std::nullopt;
    }
    const auto record = readRecord(stored);
    if (const std::string damage = damageOf(stored, record); !damage.empty())
    {
        if (damaged_.insert(stored).second)
        {
            progress_ << (stored / damage).string()
                      << " is damaged or was written by an older version; the run is repeated" << std::endl;
        }
        return std::nullopt;
    }
    RunResult result{{}, "", record.at("seconds"), true};
    const auto failures = record.value("failures", nlohmann::json::object());
    if (failures.contains(order.file))
    {
        // A run that has failed in an earlier call of the program is repeated. With a budget of 0 nothing may run, and
        // the stored failure is reported.
        if (study_.settings.budget > 0 && madeNow_.count(stored) == 0)
        {
            return std::nullopt;
        }
        result.failure = failures.at(order.file);
    }
    else if (filesMatching(stored / order.file).empty())
    {
        return std::nullopt;
    }
    else
    {
        try
        {
            result.curve = readCurve(stored / order.file, study_.timeColumn, study_.valueColumn, study_.furtherColumns);
        }
        catch (const std::exception& error)
        {
            result.failure = error.what();
        }
    }
    return result;
}

void CaseSimulator::prepare(const RunOrder& order) const
{
    const fs::path folder = copyOf(order);
    fs::remove_all(folder);
    fs::create_directories(folder);
    for (const auto& entry : fs::directory_iterator(caseFolder_))
    {
        if (!isOutput(entry.path().filename().string()))
        {
            fs::copy(entry.path(), folder / entry.path().filename(),
                fs::copy_options::recursive | fs::copy_options::copy_symlinks);
        }
    }
    replaceEntries(folder / entriesFile, order.entries);
}

/// The record is written into a folder of another name, which is renamed when it is complete. Files that other orders
/// have stored of the same run are kept.
void CaseSimulator::store(const RunOrder& order, const std::map<std::string, std::string>& failures,
    const fs::path& folder, double seconds) const
{
    const fs::path stored = cache_ / keyOf(order);
    const fs::path unfinished = stored.string() + ".unfinished";
    fs::remove_all(unfinished);
    fs::create_directories(unfinished);
    nlohmann::json checksums = nlohmann::json::object();
    const auto add = [&](const fs::path& from, const fs::path& name) {
        const std::string content = textOf(from / name);
        fs::create_directories((unfinished / name).parent_path());
        writeWhole(unfinished / name, content);
        checksums[name.string()] = sha256(content);
    };
    if (const auto before = readRecord(stored); damageOf(stored, before).empty())
    {
        for (const auto& [name, checksum] : before.at("files").items())
        {
            add(stored, name);
        }
    }
    nlohmann::json failed = nlohmann::json::object();
    for (const auto& [pattern, failure] : failures)
    {
        if (!failure.empty())
        {
            failed[pattern] = failure;
            continue;
        }
        for (const auto& file : filesMatching(folder / pattern))
        {
            add(folder, fs::relative(file, folder));
        }
    }
    nlohmann::json record = {{"key", stored.filename().string()}, {"purpose", order.purpose},
        {"command", order.command}, {"seed", order.seed}, {"entries", order.entries}, {"case", caseFolder_.string()},
        {"fingerprint", fingerprint_}, {"seconds", seconds}, {"files", checksums}, {"failures", failed}};
    record["checksum"] = checksumOf(record);
    writeWhole(unfinished / recordFile, record.dump(1) + '\n');
    renameWhole(unfinished, stored);
}

int CaseSimulator::missing(const std::vector<RunOrder>& orders)
{
    std::set<std::string> keys;
    for (const auto& order : orders)
    {
        if (!load(order))
        {
            keys.insert(keyOf(order));
        }
    }
    return static_cast<int>(keys.size());
}

std::vector<RunResult> CaseSimulator::run(const std::vector<RunOrder>& orders)
{
    std::vector<RunResult> results(orders.size());
    std::map<std::string, std::vector<std::size_t>> toDo; // places of orders, by key
    const auto loadStored = [&] {
        toDo.clear();
        for (std::size_t i = 0; i < orders.size(); ++i)
        {
            if (results[i].cached)
            {
                continue;
            }
            if (const auto stored = load(orders[i]))
            {
                results[i] = *stored;
            }
            else
            {
                toDo[keyOf(orders[i])].push_back(i);
            }
        }
    };
    loadStored();
    if (toDo.empty())
    {
        return results;
    }
    const StoreLock lock(study_.work, progress_);
    // Another process may have finished some of these runs while this one waited for the lock.
    loadStored();
    // In the order in which they were requested, so that the progress is easy to follow.
    auto wanted = mapped(toDo, [](const auto& one) { return one.second; });
    std::sort(wanted.begin(), wanted.end());
    const auto jobs = mapped(wanted, [&](const std::vector<std::size_t>& places) {
        const RunOrder& order = orders[places.front()];
        prepare(order);
        return Job{copyOf(order), order.command};
    });
    if (jobs.empty())
    {
        return results;
    }
    const double secondsPerRun = measuredSecondsPerRun().value_or(study_.simulator.costPerRun);
    Progress progress(progress_, jobs.size(), jobsAtOnce(study_.executor), secondsPerRun);
    runJobs(study_, jobs, [&](const JobEnd& end) {
        const auto& places = wanted[end.job];
        const RunOrder& order = orders[places.front()];
        const fs::path& folder = jobs[end.job].folder;
        // Most programs do not notice that a full disk has cut their output.
        if (fs::space(tree_).available < leastRoom)
        {
            throw FileError("The disk of " + tree_.string() + " is full; the run of " + order.purpose
                            + " does not count. Free some space and start again");
        }
        // By file of the observable: orders that differ in nothing else share a run.
        std::map<std::string, std::string> failures;
        for (const auto place : places)
        {
            const std::string& file = orders[place].file;
            failures[file] = end.status != 0 ? "'" + order.command + "' ended with status " + std::to_string(end.status)
                                                   + " in " + folder.string() + endOfLog(folder / jobLog)
                             : filesMatching(folder / file).empty()
                                 ? "the run has not written " + (folder / file).string()
                                 : "";
        }
        store(order, failures, folder, end.seconds);
        std::string failure;
        madeNow_.insert(cache_ / keyOf(order));
        for (const auto place : places)
        {
            RunResult& result = results[place];
            result = load(orders[place]).value_or(RunResult{});
            if (const std::string& own = failures.at(orders[place].file); !own.empty())
            {
                result.failure = failure = own;
            }
            result.seconds = end.seconds;
            result.cached = place != places.front();
        }
        if (failure.empty())
        {
            fs::remove_all(folder);
        }
        progress.ended(order.purpose, failure);
    });
    return results;
}

std::optional<double> CaseSimulator::measuredSecondsPerRun() const
{
    double sum = 0.0;
    double count = 0.0;
    for (const auto& entry : fs::directory_iterator(cache_))
    {
        const auto record = readRecord(entry.path());
        if (!record.is_null() && record.at("fingerprint") == fingerprint_
            && record.value("failures", nlohmann::json::object()).empty())
        {
            sum += record.at("seconds").get<double>();
            count += 1.0;
        }
    }
    return count > 0.0 ? std::optional(sum / count) : std::nullopt;
}

} // namespace clepsydra::identification
