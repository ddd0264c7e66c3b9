#pragma once

#include "Time.H"

#include <filesystem>
#include <string>
#include <vector>

/// \file
/// Where OpenFOAM's file handlers keep the fields of the ranks. `uncollated` and `masterUncollated` have a folder for
/// each rank, processor1; `collated` has one for all or for a group of ranks, processors4 or processors4_0-1. A serial
/// run has its fields in the case's own folder.

namespace clepsydra
{

/// Names of the folders of ranks in a case, of any file handler and any number of ranks.
std::vector<std::string> foldersOfRanks(const std::filesystem::path& caseDirectory);

/// The folders in which fields of this rank may be, as they begin the names of files in the case: "processor1/" and
/// those of its group, or "" in a serial run.
std::vector<std::string> partsOfThisRank(const std::filesystem::path& caseDirectory);

/// Whether a file of the case lies in the folder of a group of ranks, as the file handler `collated` has it.
bool isCollated(const std::string& name);

/// Number of ranks that share a file of the case, by its folder: 4 for processors4/0.1/p, otherwise 1.
int ranksOfFile(const std::string& name);

/// The name of a file of the case within the folder of its ranks: 0.1/p for processor1/0.1/p.
std::string nameInPart(const std::string& name);

/// The file in which OpenFOAM's file handler writes an object of the present time, relative to the case.
/// \param local  folder in the time folder, such as "uniform"
std::string writtenName(const Foam::Time& time, const Foam::word& name, const Foam::fileName& local);

/// Whether this rank writes the fields in its folder: the lowest of the ranks that share it. Collective.
bool writesItsPart(const Foam::Time& time);

/// \throws FileError where a file of the file handler `collated` does not hold so many whole blocks, each of which is
/// what one rank has written
void requireWholeBlocks(const std::filesystem::path& file, int blocks);

} // namespace clepsydra
