#include "engine/liggghts/fasterParts.h"

#include "engine/liggghts/hertzContactLaw.h"
#include "engine/liggghts/liggghtsErrors.h"
#include "engine/liggghts/quietRegistration.h"
#include "engine/liggghts/rows.h"
#include "tokens/renamed.h"

// Headers that LIGGGHTS' headers below use without including them.
#include <mpi.h>

#include <cctype>
#include <cfloat>
#include <climits>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <atom.h>
#include <atom_masks.h>
#include <comm.h>
#include <domain.h>
#include <error.h>
#include <fix_insert_stream.h>
#include <force.h>
#include <kspace.h>
#include <memory.h>
#include <modify.h>
#include <neigh_list.h>
#include <neighbor.h>
#include <pair.h>
#include <properties.h>
#include <suffix.h>
#include <update.h>

#include <contact_models.h>
#include <granular_pair_style.h>
#include <normal_model_hertz.h>
#include <pair_gran_base.h>
#include <surface_model_default.h>
#include <tangential_model_history.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

// The library contains the compiled templates.
template<int rollingModel>
using HertzStyle =
    LIGGGHTS::ContactModels::GranStyle<LIGGGHTS::ContactModels::HERTZ, LIGGGHTS::ContactModels::TANGENTIAL_HISTORY,
        LIGGGHTS::ContactModels::COHESION_OFF, rollingModel, LIGGGHTS::ContactModels::SURFACE_DEFAULT>;
template<int rollingModel>
using HertzOfLiggghts = LIGGGHTS::PairStyles::Granular<LIGGGHTS::ContactModels::ContactModel<HertzStyle<rollingModel>>>;
extern template class LIGGGHTS::PairStyles::Granular<
    LIGGGHTS::ContactModels::ContactModel<HertzStyle<LIGGGHTS::ContactModels::ROLLING_OFF>>>;
extern template class LIGGGHTS::PairStyles::Granular<
    LIGGGHTS::ContactModels::ContactModel<HertzStyle<LIGGGHTS::ContactModels::ROLLING_CDT>>>;

namespace clepsydra
{

namespace
{

namespace lmp = LAMMPS_NS;
namespace models = LIGGGHTS::ContactModels;

constexpr const char* resetKeyword = "tangential_reset";

/// LIGGGHTS' pair style with a loop over many contacts at a time in place of a chain of calls for each contact. Options
/// that few scripts use are left to LIGGGHTS' own loop.
///
/// LIGGGHTS keeps the tangential displacement of a contact until the next neighbour list, so particles that have
/// separated and collide again before that start with the old displacement. Here the displacement is reset at
/// separation, unless the script says `tangential_reset off`.
template<int rollingModel>
class HertzPairStyle : public HertzOfLiggghts<rollingModel>
{
    using Base = HertzOfLiggghts<rollingModel>;
    static constexpr bool rolls = rollingModel != models::ROLLING_OFF;

public:
    HertzPairStyle(lmp::LAMMPS& program, lmp::PairGran& parent, int64_t hash)
        : Base(&program, &parent, hash),
          program_(program)
    {}

    void settings(int count, char** tokens, LIGGGHTS::IContactHistorySetup* history) override
    {
        std::vector<char*> rest(tokens, tokens + count);
        readTangentialReset(rest);
        plain_ = rest.empty();
        Base::settings(static_cast<int>(rest.size()), rest.data(), history);
    }

    void init_granular() override
    {
        Base::init_granular();
        PropertyRegistry& registry = program_.force->registry;
        registry.connect("Yeff", youngsModulus_, "hertz pair style");
        registry.connect("Geff", shearModulus_, "hertz pair style");
        registry.connect("betaeff", damping_, "hertz pair style");
        registry.connect("coeffFrict", friction_, "hertz pair style");
        if constexpr (rolls)
        {
            registry.connect("coeffRollFrict", rollingFriction_, "hertz pair style");
        }
    }

    void compute_force(lmp::PairGran* pair, int energies, int virials, int forCompute) override
    {
        const ParticleArrays particles(*program_.atom);
        if (!canEvaluate(*pair, energies != 0 || virials != 0 || forCompute != 0))
        {
            for (int particle = 0; pair->listgranhistory && particle < pair->list->inum; ++particle)
            {
                findContacts(*pair, particles, pair->list->ilist[particle]);
                resetSeparated(*pair, pair->list->ilist[particle]);
            }
#ifndef __clang_analyzer__ // it follows LIGGGHTS' headers to a contact without history, which this style excludes
            Base::compute_force(pair, energies, virials, forCompute);
#endif
            return;
        }
        pair->evflag = pair->vflag_fdotr = 0;
        fillMaterials();
        const double shearStep = pair->shearupdate() ? program_.update->dt : 0;
        const lmp::NeighList& list = *pair->list;
        for (int particle = 0; particle < list.inum; ++particle)
        {
            addContacts(*pair, particles, list.ilist[particle], shearStep);
        }
        evaluate(*pair, particles, shearStep);
    }

private:
    struct Material
    {
        double youngsModulus;
        double shearModulus;
        double damping;
        double friction;
        double rollingFriction;
    };

    struct Partners
    {
        int i;
        int j;
        double* shear;
    };

    /// LIGGGHTS' arrays of the particles, three numbers of a particle for each vector.
    struct ParticleArrays
    {
        const double* position;
        const double* velocity;
        const double* angularVelocity;
        double* force;
        double* torque;
        const double* radius;
        const double* mass;
        const int* type;

        explicit ParticleArrays(const lmp::Atom& atoms)
            : position(firstElement(atoms.x)),
              velocity(firstElement(atoms.v)),
              angularVelocity(firstElement(atoms.omega)),
              force(firstElement(atoms.f)),
              torque(firstElement(atoms.torque)),
              radius(atoms.radius),
              mass(atoms.rmass),
              type(atoms.type)
        {}
    };

    /// Some of a particle's neighbours, by their index in its list.
    struct Chosen
    {
        std::vector<int> which;
        std::size_t count = 0;

        int* roomFor(int most)
        {
            which.resize(std::max(which.size(), static_cast<std::size_t>(most)));
            return which.data();
        }
    };

    /// Removes `tangential_reset on|off` from the tokens.
    void readTangentialReset(std::vector<char*>& tokens)
    {
        for (const char* word : tokens)
        {
            if (const Renamed* now = renamed(word))
            {
                throw LiggghtsStopped(std::string("'") + word + "' is now '" + now->newName + "'", false);
            }
        }
        const auto keyword = std::find_if(
            tokens.begin(), tokens.end(), [](const char* word) { return word == std::string(resetKeyword); });
        if (keyword == tokens.end())
        {
            return;
        }
        const std::string value = keyword + 1 == tokens.end() ? "" : *(keyword + 1);
        if (value != "on" && value != "off")
        {
            throw LiggghtsStopped(std::string("'") + resetKeyword + ' ' + value + "'; allowed: on, off", false);
        }
        resetsTangential_ = value == "on";
        tokens.erase(keyword, keyword + 2);
    }

    /// Whether only contact forces are needed, and nothing else that LIGGGHTS' loop computes.
    bool canEvaluate(lmp::PairGran& pair, bool asksForMore) const
    {
        const lmp::Atom& atoms = *program_.atom;
        return plain_ && !asksForMore && pair.computeflag() && pair.listgranhistory && atoms.rmass
               && program_.neighbor->contactDistanceFactor == 1 && program_.force->nktv2p == 1
               && !pair.storeContactForces() && !pair.storeContactForcesStress() && !pair.storeSumDelta()
               && !pair.store_sum_normal_force() && !pair.fr_pair() && pair.freeze_group_bit() == 0
               && program_.modify->n_fixes_style("insert/stream/predefined") == 0;
    }

    void fillMaterials()
    {
        // LIGGGHTS has no values for types that neither a particle nor a wall has.
        typeCount_ = program_.atom->get_properties()->max_type() + 1;
        materials_.resize(static_cast<std::size_t>(typeCount_) * typeCount_);
        for (int i = 1; i < typeCount_; ++i)
        {
            for (int j = 1; j < typeCount_; ++j)
            {
                materials_[i * typeCount_ + j] = {youngsModulus_[i][j], shearModulus_[i][j], damping_[i][j],
                    friction_[i][j], rolls ? rollingFriction_[i][j] : 0};
            }
        }
    }

    /// Adds the contacts of particle i with the neighbours in its list.
    void addContacts(lmp::PairGran& pair, const ParticleArrays& particles, int i, double shearStep)
    {
        findContacts(pair, particles, i);
        resetSeparated(pair, i);
        const int* const neighbours = pair.list->firstneigh[i];
        int* const flags = pair.listgranhistory->firstneigh[i];
        double* const history = pair.listgranhistory->firstdouble[i];
        for (std::size_t touch = 0; touch < touching_.count; ++touch)
        {
            const int neighbour = touching_.which[touch];
            flags[neighbour] |= models::CONTACT_NORMAL_MODEL | models::CONTACT_TANGENTIAL_MODEL;
            add(particles, {i, neighbours[neighbour] & NEIGHMASK, history + pair.dnum() * neighbour});
            if (contacts_.count == HertzContacts::most)
            {
                evaluate(pair, particles, shearStep);
            }
        }
    }

    /// Finds the neighbours that particle i touches, and those from which it has just separated.
    void findContacts(const lmp::PairGran& pair, const ParticleArrays& particles, int i)
    {
        const int* const neighbours = pair.list->firstneigh[i];
        const int* const flags = pair.listgranhistory->firstneigh[i];
        const int neighbourCount = pair.list->numneigh[i];
        const double* const at = particles.position + 3 * static_cast<std::ptrdiff_t>(i);
        const double radius = particles.radius[i];
        int* const touching = touching_.roomFor(neighbourCount);
        int* const separated = separated_.roomFor(neighbourCount);
        std::size_t touchingCount = 0;
        std::size_t separatedCount = 0;
        for (int neighbour = 0; neighbour < neighbourCount; ++neighbour)
        {
            const std::ptrdiff_t j = neighbours[neighbour] & NEIGHMASK;
            const double* const position = particles.position + 3 * j;
            const double dx = at[0] - position[0];
            const double dy = at[1] - position[1];
            const double dz = at[2] - position[2];
            const double reach = radius + particles.radius[j];
            const bool touches = dx * dx + dy * dy + dz * dz < reach * reach;
            const bool touched = flags[neighbour] != 0;
            // Without a branch, because one neighbour in three is in contact, which no processor predicts.
            touching[touchingCount] = neighbour;
            touchingCount += touches ? 1 : 0;
            separated[separatedCount] = neighbour;
            separatedCount += !touches & touched ? 1 : 0;
        }
        touching_.count = touchingCount;
        separated_.count = separatedCount;
    }

    void resetSeparated(lmp::PairGran& pair, int i)
    {
        for (std::size_t contact = 0; resetsTangential_ && contact < separated_.count; ++contact)
        {
            const int neighbour = separated_.which[contact];
            pair.listgranhistory->firstneigh[i][neighbour] = 0;
            std::fill_n(pair.listgranhistory->firstdouble[i] + pair.dnum() * neighbour, pair.dnum(), 0.0);
        }
    }

    void add(const ParticleArrays& particles, const Partners& partners)
    {
        HertzContacts& c = contacts_;
        const std::size_t k = c.count++;
        partners_[k] = partners;
        const std::ptrdiff_t i = partners.i;
        const std::ptrdiff_t j = partners.j;
        for (int axis = 0; axis < 3; ++axis)
        {
            c.distance[axis][k] = particles.position[3 * i + axis] - particles.position[3 * j + axis];
            c.velocity[axis][k] = particles.velocity[3 * i + axis] - particles.velocity[3 * j + axis];
            c.angularVelocityI[axis][k] = particles.angularVelocity[3 * i + axis];
            c.angularVelocityJ[axis][k] = particles.angularVelocity[3 * j + axis];
            c.shear[axis][k] = partners.shear[axis];
        }
        c.radiusI[k] = particles.radius[i];
        c.radiusJ[k] = particles.radius[j];
        c.massI[k] = particles.mass[i];
        c.massJ[k] = particles.mass[j];
        const Material& material = materials_[particles.type[i] * typeCount_ + particles.type[j]];
        c.youngsModulus[k] = material.youngsModulus;
        c.shearModulus[k] = material.shearModulus;
        c.damping[k] = material.damping;
        c.friction[k] = material.friction;
        c.rollingFriction[k] = material.rollingFriction;
    }

    /// Applies the forces of the contacts that have been added, and clears the list of contacts.
    void evaluate(lmp::PairGran& pair, const ParticleArrays& particles, double shearStep)
    {
        HertzContacts& c = contacts_;
        (rolls ? evaluateHertzRolling : evaluateHertz)(c, shearStep);
        const bool alsoOnGhosts = program_.force->newton_pair != 0;
        const int localCount = program_.atom->nlocal;
        for (std::size_t k = 0; k < c.count; ++k)
        {
            double* const shear = partners_[k].shear;
            const std::ptrdiff_t i = partners_[k].i;
            const std::ptrdiff_t j = partners_[k].j;
            const double relaxI = pair.relax(partners_[k].i);
            for (int axis = 0; axis < 3; ++axis)
            {
                shear[axis] = c.shear[axis][k];
                particles.force[3 * i + axis] += relaxI * c.force[axis][k];
                particles.torque[3 * i + axis] += relaxI * c.torqueI[axis][k];
            }
            if (alsoOnGhosts || j < localCount)
            {
                const double relaxJ = pair.relax(partners_[k].j);
                for (int axis = 0; axis < 3; ++axis)
                {
                    particles.force[3 * j + axis] -= relaxJ * c.force[axis][k];
                    particles.torque[3 * j + axis] += relaxJ * c.torqueJ[axis][k];
                }
            }
        }
        c.count = 0;
    }

    lmp::LAMMPS& program_;
    /// True where the script's line has no further tokens, such as limitForce.
    bool plain_ = false;
    bool resetsTangential_ = true;
    double** youngsModulus_ = nullptr;
    double** shearModulus_ = nullptr;
    double** damping_ = nullptr;
    double** friction_ = nullptr;
    double** rollingFriction_ = nullptr;
    int typeCount_ = 0;
    /// Indexed by the two types.
    std::vector<Material> materials_;
    Chosen touching_;
    Chosen separated_;
    HertzContacts contacts_;
    std::array<Partners, HertzContacts::most> partners_;
};

template<int rollingModel>
void registerStyle()
{
    using Created = LIGGGHTS::PairStyles::IGranularPairStyle*;
    LIGGGHTS::PairStyles::Factory::instance().addStyle("gran", static_cast<int>(HertzStyle<rollingModel>::HASHCODE),
        [](lmp::LAMMPS* program, lmp::PairGran* parent, int64_t hash) -> Created {
            return new HertzPairStyle<rollingModel>(*program, *parent, hash);
        });
}

} // namespace

void registerHertzPairStyle()
{
    const QuietRegistration quiet;
    registerStyle<models::ROLLING_OFF>();
    registerStyle<models::ROLLING_CDT>();
}

} // namespace clepsydra
