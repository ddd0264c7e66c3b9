#include "runner/executor.h"

#include "runner/processPool.h"
#include "runner/slurmArray.h"

namespace clepsydra::identification
{

std::unique_ptr<Executor> makeExecutor(
    const ExecutorSpecification& specification, const std::filesystem::path& work, double timeLimit)
{
    if (specification.kind == "slurm")
    {
        return std::make_unique<SlurmArray>(specification.processes, specification.options, work, timeLimit);
    }
    return std::make_unique<ProcessPool>(specification.processes, timeLimit);
}

} // namespace clepsydra::identification
