#include "engine/liggghts/subdomains.h"

#include "engine/demEngine.h"
#include "engine/liggghts/fixStyles.h"
#include "files/wholeFile.h"

// A header that LIGGGHTS' headers below use without including it.
#include <mpi.h>

#include <atom.h>
#include <comm.h>
#include <domain.h>
#include <error.h>
#include <fix.h>
#include <fix_mesh.h>
#include <abstract_mesh.h>
#include <lammps.h>
#include <modify.h>
#include <neighbor.h>
#include <update.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>

namespace clepsydra
{

namespace
{

namespace lmp = LAMMPS_NS;

constexpr std::size_t directions = 3;

/// Where each direction of the box is cut, as fractions from 0 to 1: one cut more than there are ranks along it.
using Cuts = std::array<std::vector<double>, directions>;

/// LIGGGHTS' box, of which the ranks may have parts of different size.
class Subdomains : public lmp::Domain
{
public:
    using Domain::Domain;

    /// Without cuts all ranks have parts of the same size.
    void cutAt(Cuts cuts)
    {
        cuts_ = std::move(cuts);
    }

    bool areEqual() const
    {
        return cuts_.front().empty();
    }

    Cuts cuts() const
    {
        Cuts result;
        for (std::size_t direction = 0; direction < directions; ++direction)
        {
            const double* const first = splits()[direction];
            result[direction].assign(first, first + comm->procgrid[direction] + 1);
        }
        return result;
    }

    void set_local_box() override
    {
        // A run that is resumed on ranks that are arranged otherwise begins with equal parts again.
        if (!std::equal(cuts_.begin(), cuts_.end(), comm->procgrid, [](const std::vector<double>& cuts, int ranks) {
                return cuts.size() == static_cast<std::size_t>(ranks) + 1;
            }))
        {
            cuts_ = {};
        }
        for (std::size_t direction = 0; !areEqual() && direction < directions; ++direction)
        {
            std::copy(cuts_[direction].begin(), cuts_[direction].end(), splits()[direction]);
        }
        comm->uniform = areEqual() ? 1 : 0;
        Domain::set_local_box();
    }

private:
    std::array<double*, directions> splits() const
    {
        return {comm->xsplit, comm->ysplit, comm->zsplit};
    }

    /// What `comm` gets again each time that LIGGGHTS has arranged the ranks.
    Cuts cuts_;
};

Subdomains& subdomainsOf(const lmp::LAMMPS& program)
{
    return static_cast<Subdomains&>(*program.domain);
}

/// The directions are cut apart from each other, by the number of particles on both sides of a cut.
class FixBalance : public lmp::Fix
{
public:
    FixBalance(lmp::LAMMPS* program, int count, char** tokens)
        : Fix(program, count, tokens)
    {
        constexpr int every = 3;
        constexpr int threshold = 4;
        char* rest = nullptr;
        steps_ = count > every ? std::strtol(tokens[every], &rest, 10) : 0;
        const bool stepsAreRead = rest && *rest == '\0';
        threshold_ = count > threshold ? std::strtod(tokens[threshold], &rest) : 0;
        if (count != threshold + 1 || !stepsAreRead || *rest != '\0' || steps_ < 1 || !(threshold_ > 1) || igroup != 0)
        {
            error->all(FLERR,
                "Illegal fix balance command; allowed: 'fix ID all balance N threshold' with a number N of "
                "DEM steps and a threshold above 1 for the particles of the busiest rank over the mean");
        }
        restart_global = 1;
        scalar_flag = 1;
        global_freq = 1;
    }

    int setmask() override
    {
        return lmp::FixConst::PRE_EXCHANGE;
    }

    void init() override
    {
        const bool isTilted = domain->triclinic != 0;
        const auto* const other = std::find_if(modify->fix, modify->fix + modify->nfix, [](const lmp::Fix* fix) {
            const std::string ofFix = fix->style;
            return ofFix.rfind("insert/", 0) == 0 || ofFix == "ave/euler";
        });
        if (isTilted || other != modify->fix + modify->nfix)
        {
            error->all(FLERR,
                ("fix balance cannot be used with "
                    + (isTilted ? std::string("a tilted box") : std::string("fix ") + (*other)->style)
                    + ", which measures the boxes of the ranks once; allowed: 'unfix' for it before the run, or no "
                      "fix balance")
                    .c_str());
        }
    }

    /// At the start of a run that is not resumed; LIGGGHTS then derives the rest from the boxes by itself.
    void setup_pre_exchange() override
    {
        if (next_ == 0)
        {
            moveCuts();
        }
    }

    void pre_exchange() override
    {
        if (moveCuts())
        {
            takeOver();
        }
    }

    /// Particles of the busiest rank over the mean.
    double compute_scalar() override
    {
        lmp::bigint most = atom->nlocal;
        lmp::bigint all = most;
        MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_LMP_BIGINT, MPI_MAX, world);
        MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
        return all > 0 ? static_cast<double>(most) * comm->nprocs / static_cast<double>(all) : 1;
    }

    void write_restart(FILE* file) override
    {
        if (comm->me == 0)
        {
            const int size = sizeof(next_);
            std::fwrite(&size, sizeof(size), 1, file);
            std::fwrite(&next_, sizeof(next_), 1, file);
        }
    }

    void restart(char* state) override
    {
        std::copy_n(state, sizeof(next_), reinterpret_cast<char*>(&next_));
    }

private:
    /// Moves the cuts if it is time to and if it relieves the busiest rank.
    bool moveCuts()
    {
        if (comm->nprocs == 1 || update->ntimestep < next_)
        {
            return false;
        }
        next_ = (update->ntimestep / steps_ + 1) * steps_;
        domain->pbc();
        Subdomains& subdomains = subdomainsOf(*lmp);
        const Cuts before = subdomains.cuts();
        if (compute_scalar() <= threshold_)
        {
            return false;
        }
        const Cuts after = betterCuts(before);
        const bool isBetter = busiest(after) < busiest(before);
        if (isBetter)
        {
            subdomains.cutAt(after);
            subdomains.set_local_box();
            atom->setup();
        }
        return isBetter;
    }

    /// Place of a particle in the box, from 0 to 1.
    double place(int particle, std::size_t direction) const
    {
        return (atom->x[particle][direction] - domain->boxlo[direction]) / domain->prd[direction];
    }

    /// Cuts with equal numbers of particles between them. A cut stays between the two that were beside it, as far away from
    /// them as particles see each other, because particles and triangles are sent to adjacent ranks only.
    Cuts betterCuts(const Cuts& before) const
    {
        constexpr std::size_t slices = 1024;
        std::vector<lmp::bigint> counts(directions * slices);
        for (int particle = 0; particle < atom->nlocal; ++particle)
        {
            for (std::size_t direction = 0; direction < directions; ++direction)
            {
                const double slice = std::clamp(place(particle, direction) * slices, 0., slices - 1.);
                ++counts[direction * slices + static_cast<std::size_t>(slice)];
            }
        }
        MPI_Allreduce(MPI_IN_PLACE, counts.data(), static_cast<int>(counts.size()), MPI_LMP_BIGINT, MPI_SUM, world);
        Cuts after = before;
        for (std::size_t direction = 0; direction < directions; ++direction)
        {
            const auto first = counts.begin() + static_cast<std::ptrdiff_t>(direction * slices);
            const std::vector<lmp::bigint> ofDirection(first, first + slices);
            const double narrowest = neighbor->cutneighmax / domain->prd[direction];
            for (std::size_t cut = 1; cut + 1 < before[direction].size(); ++cut)
            {
                const double share = static_cast<double>(cut) / comm->procgrid[direction];
                const double low = std::max(before[direction][cut - 1], after[direction][cut - 1]) + narrowest;
                const double high = before[direction][cut + 1] - narrowest;
                if (low < high)
                {
                    after[direction][cut] = std::clamp(placeOfShare(ofDirection, share), low, high);
                }
            }
        }
        return after;
    }

    /// Below which place the share of all particles lies; particles are spread evenly over a slice.
    static double placeOfShare(const std::vector<lmp::bigint>& counts, double share)
    {
        const double wanted =
            share * static_cast<double>(std::accumulate(counts.begin(), counts.end(), lmp::bigint(0)));
        double below = 0;
        std::size_t slice = 0;
        while (slice + 1 < counts.size() && below + static_cast<double>(counts[slice]) < wanted)
        {
            below += static_cast<double>(counts[slice++]);
        }
        const auto inSlice = static_cast<double>(counts[slice]);
        const double part = inSlice > 0 ? (wanted - below) / inSlice : 0;
        return (static_cast<double>(slice) + part) / static_cast<double>(counts.size());
    }

    /// Particles of the busiest rank.
    lmp::bigint busiest(const Cuts& cuts) const
    {
        std::vector<lmp::bigint> counts(comm->nprocs);
        for (int particle = 0; particle < atom->nlocal; ++particle)
        {
            std::size_t box = 0;
            for (std::size_t direction = 0; direction < directions; ++direction)
            {
                const std::vector<double>& inDirection = cuts[direction];
                const auto above =
                    std::upper_bound(inDirection.begin() + 1, inDirection.end() - 1, place(particle, direction));
                box = box * (inDirection.size() - 1) + static_cast<std::size_t>(above - inDirection.begin() - 1);
            }
            ++counts[box];
        }
        MPI_Allreduce(MPI_IN_PLACE, counts.data(), static_cast<int>(counts.size()), MPI_LMP_BIGINT, MPI_SUM, world);
        return *std::max_element(counts.begin(), counts.end());
    }

    /// What else LIGGGHTS has derived from the boxes. The particles follow next, when it exchanges them.
    void takeOver()
    {
        comm->setup();
        neighbor->setup_bins();
        // Meshes at rest exchange triangles only if the box changes.
        const int changes = std::exchange(domain->box_change, 1);
        std::for_each(modify->fix, modify->fix + modify->nfix, [](lmp::Fix* fix) {
            if (auto* const mesh = dynamic_cast<lmp::FixMesh*>(fix))
            {
                constexpr int setupFlag = 0;
                mesh->mesh()->pbcExchangeBorders(setupFlag);
            }
        });
        domain->box_change = changes;
    }

    lmp::bigint steps_ = 0;
    double threshold_ = 0;
    /// The DEM step from which on the ranks are compared again.
    lmp::bigint next_ = 0;
};

std::filesystem::path fileBeside(const std::filesystem::path& checkpoint)
{
    std::string name = checkpoint.string();
    const std::size_t rank = name.find('%');
    return rank == std::string::npos ? name + ".subdomains" : name.replace(rank, 1, "subdomains");
}

} // namespace

void allowUnequalSubdomains(LiggghtsProgram& program)
{
    delete std::exchange(program->domain, new Subdomains(&*program));
    setFixStyle(program, "balance", [](lmp::LAMMPS* liggghts, int count, char** tokens) -> lmp::Fix* {
        return new FixBalance(liggghts, count, tokens);
    });
}

std::vector<std::filesystem::path> writeSubdomains(
    const LiggghtsProgram& program, const std::filesystem::path& checkpoint)
{
    const Subdomains& subdomains = subdomainsOf(*program);
    if (subdomains.areEqual())
    {
        return {};
    }
    std::ostringstream text;
    text.precision(std::numeric_limits<double>::max_digits10);
    for (const std::vector<double>& cuts : subdomains.cuts())
    {
        std::copy(cuts.begin(), cuts.end(), std::ostream_iterator<double>(text, " "));
        text << '\n';
    }
    const std::filesystem::path file = fileBeside(checkpoint);
    writeWhole(file, text.str());
    return {file};
}

void readSubdomains(LiggghtsProgram& program, const std::filesystem::path& checkpoint)
{
    const std::filesystem::path file = fileBeside(checkpoint);
    if (!std::filesystem::exists(file))
    {
        return;
    }
    std::istringstream text(textOf(file));
    Cuts cuts;
    for (std::vector<double>& inDirection : cuts)
    {
        std::string line;
        std::getline(text, line);
        std::istringstream numbers(line);
        inDirection.assign(std::istream_iterator<double>(numbers), {});
        if (!numbers.eof() || inDirection.size() < 2 || !std::is_sorted(inDirection.begin(), inDirection.end()))
        {
            throw DemEngineError(
                file.string() + ": not the boxes of the ranks; allowed: the file as the checkpoint was written");
        }
    }
    subdomainsOf(*program).cutAt(cuts);
}

} // namespace clepsydra
