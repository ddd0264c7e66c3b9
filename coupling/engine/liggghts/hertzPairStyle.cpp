#include "engine/liggghts/hertzPairStyle.h"

#include "engine/liggghts/hertzContactLaw.h"
#include "engine/liggghts/liggghtsErrors.h"
#include "engine/liggghts/quietRegistration.h"
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

// The library contains the compiled template.
using HertzStyle = LIGGGHTS::ContactModels::GranStyle<LIGGGHTS::ContactModels::HERTZ,
    LIGGGHTS::ContactModels::TANGENTIAL_HISTORY, LIGGGHTS::ContactModels::COHESION_OFF,
    LIGGGHTS::ContactModels::ROLLING_OFF, LIGGGHTS::ContactModels::SURFACE_DEFAULT>;
extern template class LIGGGHTS::PairStyles::Granular<LIGGGHTS::ContactModels::ContactModel<HertzStyle>>;

namespace clepsydra
{

namespace
{

namespace lmp = LAMMPS_NS;
namespace models = LIGGGHTS::ContactModels;

using HertzOfLiggghts = LIGGGHTS::PairStyles::Granular<models::ContactModel<HertzStyle>>;

constexpr const char* resetKeyword = "tangential_reset";

/// LIGGGHTS' pair style with a loop over many contacts at a time in place of a chain of calls for each contact. Options
/// that few scripts use are left to LIGGGHTS' own loop.
///
/// LIGGGHTS keeps the tangential displacement of a contact until the next neighbour list, so particles that have
/// separated and collide again before that start with the old displacement. Here the displacement is reset at
/// separation, unless the script says `tangential_reset off`.
class HertzPairStyle : public HertzOfLiggghts
{
public:
    HertzPairStyle(lmp::LAMMPS& program, lmp::PairGran& parent, int64_t hash)
        : HertzOfLiggghts(&program, &parent, hash),
          program_(program)
    {}

    void settings(int count, char** tokens, LIGGGHTS::IContactHistorySetup* history) override
    {
        std::vector<char*> rest(tokens, tokens + count);
        readTangentialReset(rest);
        plain_ = rest.empty();
        HertzOfLiggghts::settings(static_cast<int>(rest.size()), rest.data(), history);
    }

    void init_granular() override
    {
        HertzOfLiggghts::init_granular();
        PropertyRegistry& registry = program_.force->registry;
        registry.connect("Yeff", youngsModulus_, "hertz pair style");
        registry.connect("Geff", shearModulus_, "hertz pair style");
        registry.connect("betaeff", damping_, "hertz pair style");
        registry.connect("coeffFrict", friction_, "hertz pair style");
    }

    void compute_force(lmp::PairGran* pair, int energies, int virials, int forCompute) override
    {
        if (!canEvaluate(*pair, energies != 0 || virials != 0 || forCompute != 0))
        {
            for (int particle = 0; pair->listgranhistory && particle < pair->list->inum; ++particle)
            {
                findContacts(*pair, pair->list->ilist[particle]);
                resetSeparated(*pair, pair->list->ilist[particle]);
            }
#ifndef __clang_analyzer__ // it follows LIGGGHTS' headers to a contact without history, which this style excludes
            HertzOfLiggghts::compute_force(pair, energies, virials, forCompute);
#endif
            return;
        }
        pair->evflag = pair->vflag_fdotr = 0;
        fillMaterials();
        const double shearStep = pair->shearupdate() ? program_.update->dt : 0;
        const lmp::NeighList& list = *pair->list;
        for (int particle = 0; particle < list.inum; ++particle)
        {
            addContacts(*pair, list.ilist[particle], shearStep);
        }
        evaluate(*pair, shearStep);
    }

private:
    struct Material
    {
        double youngsModulus;
        double shearModulus;
        double damping;
        double friction;
    };

    struct Partners
    {
        int i;
        int j;
        double* shear;
    };

    /// Some of a particle's neighbours, by their index in its list.
    struct Chosen
    {
        std::vector<int> which;
        std::size_t count = 0;

        void clear(int most)
        {
            which.resize(std::max(which.size(), static_cast<std::size_t>(most)));
            count = 0;
        }

        /// Without a branch, because one neighbour in three is in contact, which no processor predicts.
        void addIf(bool isChosen, int neighbour)
        {
            which[count] = neighbour;
            count += isChosen ? 1 : 0;
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
                materials_[i * typeCount_ + j] = {
                    youngsModulus_[i][j], shearModulus_[i][j], damping_[i][j], friction_[i][j]};
            }
        }
    }

    /// Adds the contacts of particle i with the neighbours in its list.
    void addContacts(lmp::PairGran& pair, int i, double shearStep)
    {
        findContacts(pair, i);
        resetSeparated(pair, i);
        const int* const neighbours = pair.list->firstneigh[i];
        int* const flags = pair.listgranhistory->firstneigh[i];
        double* const history = pair.listgranhistory->firstdouble[i];
        for (std::size_t touch = 0; touch < touching_.count; ++touch)
        {
            const int neighbour = touching_.which[touch];
            flags[neighbour] |= models::CONTACT_NORMAL_MODEL | models::CONTACT_TANGENTIAL_MODEL;
            add({i, neighbours[neighbour] & NEIGHMASK, history + pair.dnum() * neighbour});
            if (contacts_.count == HertzContacts::most)
            {
                evaluate(pair, shearStep);
            }
        }
    }

    /// Finds the neighbours that particle i touches, and those from which it has just separated.
    void findContacts(const lmp::PairGran& pair, int i)
    {
        const lmp::Atom& atoms = *program_.atom;
        const int* const neighbours = pair.list->firstneigh[i];
        const int* const flags = pair.listgranhistory->firstneigh[i];
        const int neighbourCount = pair.list->numneigh[i];
        const double* const at = atoms.x[i];
        const double radius = atoms.radius[i];
        touching_.clear(neighbourCount);
        separated_.clear(neighbourCount);
        for (int neighbour = 0; neighbour < neighbourCount; ++neighbour)
        {
            const int j = neighbours[neighbour] & NEIGHMASK;
            const double dx = at[0] - atoms.x[j][0];
            const double dy = at[1] - atoms.x[j][1];
            const double dz = at[2] - atoms.x[j][2];
            const double reach = radius + atoms.radius[j];
            const bool touches = dx * dx + dy * dy + dz * dz < reach * reach;
            const bool touched = flags[neighbour] != 0;
            touching_.addIf(touches, neighbour);
            separated_.addIf(!touches & touched, neighbour);
        }
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

    void add(const Partners& partners)
    {
        const lmp::Atom& atoms = *program_.atom;
        const auto [i, j, shear] = partners;
        HertzContacts& c = contacts_;
        const std::size_t k = c.count++;
        partners_[k] = partners;
        for (int axis = 0; axis < 3; ++axis)
        {
            c.distance[axis][k] = atoms.x[i][axis] - atoms.x[j][axis];
            c.velocity[axis][k] = atoms.v[i][axis] - atoms.v[j][axis];
            c.angularVelocityI[axis][k] = atoms.omega[i][axis];
            c.angularVelocityJ[axis][k] = atoms.omega[j][axis];
            c.shear[axis][k] = shear[axis];
        }
        c.radiusI[k] = atoms.radius[i];
        c.radiusJ[k] = atoms.radius[j];
        c.massI[k] = atoms.rmass[i];
        c.massJ[k] = atoms.rmass[j];
        const Material& material = materials_[atoms.type[i] * typeCount_ + atoms.type[j]];
        c.youngsModulus[k] = material.youngsModulus;
        c.shearModulus[k] = material.shearModulus;
        c.damping[k] = material.damping;
        c.friction[k] = material.friction;
    }

    /// Applies the forces of the contacts that have been added, and clears the list of contacts.
    void evaluate(lmp::PairGran& pair, double shearStep)
    {
        HertzContacts& c = contacts_;
        evaluateHertz(c, shearStep);
        const lmp::Atom& atoms = *program_.atom;
        const bool alsoOnGhosts = program_.force->newton_pair != 0;
        for (std::size_t k = 0; k < c.count; ++k)
        {
            const auto [i, j, shear] = partners_[k];
            const double relaxI = pair.relax(i);
            for (int axis = 0; axis < 3; ++axis)
            {
                shear[axis] = c.shear[axis][k];
                atoms.f[i][axis] += relaxI * c.force[axis][k];
                atoms.torque[i][axis] += relaxI * c.torqueI[axis][k];
            }
            if (alsoOnGhosts || j < atoms.nlocal)
            {
                const double relaxJ = pair.relax(j);
                for (int axis = 0; axis < 3; ++axis)
                {
                    atoms.f[j][axis] -= relaxJ * c.force[axis][k];
                    atoms.torque[j][axis] += relaxJ * c.torqueJ[axis][k];
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
    int typeCount_ = 0;
    /// Indexed by the two types.
    std::vector<Material> materials_;
    Chosen touching_;
    Chosen separated_;
    HertzContacts contacts_;
    std::array<Partners, HertzContacts::most> partners_;
};

LIGGGHTS::PairStyles::IGranularPairStyle* create(lmp::LAMMPS* program, lmp::PairGran* parent, int64_t hash)
{
    return new HertzPairStyle(*program, *parent, hash);
}

} // namespace

void registerHertzPairStyle()
{
    const QuietRegistration quiet;
    LIGGGHTS::PairStyles::Factory::instance().addStyle("gran", static_cast<int>(HertzStyle::HASHCODE), &create);
}

} // namespace clepsydra
