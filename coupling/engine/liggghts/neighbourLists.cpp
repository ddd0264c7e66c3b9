// Compiled without fused multiply-add, so that rounding is the same as in LIGGGHTS: see CMakeLists.txt.
#include "engine/liggghts/fasterParts.h"

#include "engine/liggghts/liggghtsProgram.h"
#include "vectorUnits.h"

// Headers that LIGGGHTS' headers below use without including them.
#include <mpi.h>

#include <atom.h>
#include <error.h>
#include <fix_contact_history.h>
#include <lammps.h>
#include <neigh_list.h>
#include <neighbor.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace clepsydra
{

namespace
{

namespace lmp = LAMMPS_NS;

/// Spheres with each coordinate of all of them side by side for vector units. SI units.
struct Spheres
{
    std::vector<double> x;
    std::vector<double> y;
    std::vector<double> z;
    std::vector<double> radius;
    /// Results of markNear: the square of the distance of the centres, and 1 for spheres that are near, otherwise 0.
    std::vector<double> distanceSquared;
    std::vector<char> isNear;

    void resize(std::size_t count)
    {
        for (std::vector<double>* values : {&x, &y, &z, &radius, &distanceSquared})
        {
            values->resize(count);
        }
        isNear.resize(count);
    }
};

/// When two spheres are near each other: if their centres are no further apart than the sum of their radii, times
/// `radiusFactor`, plus `skin`.
struct Nearness
{
    double radiusFactor;
    double skin;
};

/// Finds which of the spheres from `first` to before `last` are near the sphere `of`. It has LIGGGHTS' operations in their
/// order, so a pair at the limit is decided as LIGGGHTS decides it.
CLEPSYDRA_FOR_VECTOR_UNITS void markNear(
    Spheres& spheres, std::size_t first, std::size_t last, std::size_t of, const Nearness& nearness)
{
    const double* const x = spheres.x.data();
    const double* const y = spheres.y.data();
    const double* const z = spheres.z.data();
    const double* const radius = spheres.radius.data();
    double* __restrict const distanceSquared = spheres.distanceSquared.data();
    char* __restrict const isNear = spheres.isNear.data();
    const double atX = x[of];
    const double atY = y[of];
    const double atZ = z[of];
    const double ofRadius = radius[of];
    const auto [radiusFactor, skin] = nearness;
    for (std::size_t k = first; k < last; ++k)
    {
        const double dx = atX - x[k];
        const double dy = atY - y[k];
        const double dz = atZ - z[k];
        const double squared = dx * dx + dy * dy + dz * dz;
        const double reach = (ofRadius + radius[k]) * radiusFactor + skin;
        distanceSquared[k] = squared;
        isNear[k] = squared <= reach * reach ? 1 : 0;
    }
}

/// Bins whose particles lie side by side, as offsets from a particle's own bin.
struct BinRow
{
    int first;
    int last;
};

/// LIGGGHTS' neighbour lists. Those of spheres with contact history are built from copies of the particles' positions,
/// sorted by bins: the particles of bins side by side are compared with a particle in one loop for vector units.
class NeighbourLists : public lmp::Neighbor
{
public:
    using lmp::Neighbor::Neighbor;

protected:
    void choose_build(int index, lmp::NeighRequest* request) override
    {
        lmp::Neighbor::choose_build(index, request);
        if (pair_build[index] == &NeighbourLists::granular_bin_no_newton)
        {
            pair_build[index] = static_cast<PairPtr>(&NeighbourLists::build);
        }
    }

private:
    void build(lmp::NeighList* list)
    {
        bin_atoms();
        sortByBins();
        joinBins(*list);
        const int count = includegroup ? atom->nfirst : atom->nlocal;
        list->ipage->reset();
        if (list->fix_history)
        {
            list->listgranhistory->ipage->reset();
            list->listgranhistory->dpage->reset();
        }
        for (int i = 0; i < count; ++i)
        {
            findNeighbours(*list, i);
            list->ilist[i] = i;
        }
        list->inum = count;
    }

    /// Copies the particles into the order of their bins, and within a bin as LIGGGHTS' linked list has them.
    void sortByBins()
    {
        const auto count = static_cast<std::size_t>(atom->nlocal) + static_cast<std::size_t>(atom->nghost);
        sorted_.resize(count);
        particle_.resize(count);
        place_.resize(count);
        near_.resize(count + 1);
        firstOfBin_.resize(static_cast<std::size_t>(mbins) + 1);
        int at = 0;
        for (int bin = 0; bin < mbins; ++bin)
        {
            firstOfBin_[bin] = at;
            for (int j = binhead[bin]; j >= 0; j = bins[j])
            {
                sorted_.x[at] = atom->x[j][0];
                sorted_.y[at] = atom->x[j][1];
                sorted_.z[at] = atom->x[j][2];
                sorted_.radius[at] = atom->radius[j];
                particle_[at] = j;
                place_[j] = at;
                ++at;
            }
        }
        firstOfBin_[mbins] = at;
    }

    /// Joins bins of the stencil that lie side by side.
    void joinBins(const lmp::NeighList& list)
    {
        rows_.clear();
        std::for_each(list.stencil, list.stencil + list.nstencil, [this](int offset) {
            if (!rows_.empty() && rows_.back().last + 1 == offset)
            {
                rows_.back().last = offset;
            }
            else
            {
                rows_.push_back({offset, offset});
            }
        });
    }

    /// Writes the neighbours of particle i that have not found it already, with their contact history.
    void findNeighbours(lmp::NeighList& list, int i)
    {
        const int place = place_[i];
        const int bin = coord2bin(atom->x[i]);
        // Without members in the loop, which the compiler would load and store for every particle.
        int* const near = near_.data();
        const int* const particle = particle_.data();
        const char* const isNear = sorted_.isNear.data();
        int count = 0;
        for (const BinRow& row : rows_)
        {
            const int first = firstOfBin_[bin + row.first];
            const int last = firstOfBin_[bin + row.last + 1];
            markNear(sorted_, first, last, place, {contactDistanceFactor, skin});
            for (int k = first; k < last; ++k)
            {
                // Without a branch, because one of seven is near, which no processor predicts.
                near[count] = k;
                count += isNear[k] & (particle[k] > i ? 1 : 0);
            }
        }
        nearCount_ = count;
        if (exclude != 0)
        {
            const auto isExcluded = [this, i](int k) {
                return exclusion(i, particle_[k], atom->type[i], atom->type[particle_[k]], atom->mask, atom->molecule)
                       != 0;
            };
            nearCount_ =
                static_cast<int>(std::remove_if(near_.begin(), near_.begin() + nearCount_, isExcluded) - near_.begin());
        }
        int* const neighbours = list.ipage->get(nearCount_);
        if (!neighbours)
        {
            overflow();
        }
        std::transform(near_.begin(), near_.begin() + nearCount_, neighbours, [this](int k) { return particle_[k]; });
        list.firstneigh[i] = neighbours;
        list.numneigh[i] = nearCount_;
        if (list.fix_history)
        {
            copyHistory(list, i);
        }
    }

    void copyHistory(lmp::NeighList& list, int i)
    {
        lmp::NeighList& history = *list.listgranhistory;
        const int count = nearCount_;
        int* const isContact = history.ipage->get(count);
        double* const values = history.dpage->get(count * history.dnum);
        if (!isContact || !values)
        {
            overflow();
        }
        std::fill_n(isContact, count, 0);
        std::fill_n(values, count * history.dnum, 0.0);
        lmp::FixContactHistory& contacts = *list.fix_history;
        const int contactCount = contacts.n_partner(i);
        for (int neighbour = 0; contactCount > 0 && neighbour < count; ++neighbour)
        {
            const int k = near_[neighbour];
            const int j = particle_[k];
            const double reach = (atom->radius[i] + atom->radius[j]) * contactDistanceFactor;
            int contact = 0;
            while (sorted_.distanceSquared[k] < reach * reach && contact < contactCount)
            {
                if (contacts.partner(i, contact) == atom->tag[j])
                {
                    isContact[neighbour] = 1;
                    std::copy_n(contacts.contacthistory(i, contact), history.dnum, values + neighbour * history.dnum);
                    break;
                }
                ++contact;
            }
        }
        history.firstneigh[i] = isContact;
        history.firstdouble[i] = values;
    }

    void overflow() const
    {
        error->one(FLERR, "Neighbor list overflow, boost neigh_modify one");
    }

    Spheres sorted_;
    /// The particle at a place in the order of the bins, and the place of a particle.
    std::vector<int> particle_;
    std::vector<int> place_;
    /// By bin, and one more value: the number of particles in all bins.
    std::vector<int> firstOfBin_;
    std::vector<BinRow> rows_;
    /// Places of the neighbours of one particle, and how many these are.
    std::vector<int> near_;
    int nearCount_ = 0;
};

} // namespace

void replaceNeighbourSearch(LiggghtsProgram& program)
{
    lmp::LAMMPS& liggghts = *program.operator->();
    delete liggghts.neighbor;
    liggghts.neighbor = new NeighbourLists(&liggghts);
}

} // namespace clepsydra
