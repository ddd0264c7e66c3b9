/// \file
/// Preloaded, makes LIGGGHTS appear as one that was built with other flags, or as another version. A lie for each
/// library, chosen when it is compiled:
///
///     LIE_NONE     calls LIGGGHTS' own functions only
///     LIE_VERSION  another version number
///     LIE_SIZE     a larger class Atom
///     LIE_MEMBER   an array at another place of the class Atom
///     LIE_TAG      ids of 64 bits, as with -DLAMMPS_BIGBIG of later versions
///     LIE_FORCE    a contact force that is greater by 1e-9 of its value
///
/// Each says on stderr that it was called: a LIGGGHTS that was linked with -Bsymbolic-functions calls no preloaded function.

#include <mpi.h>

#include <atom.h>
#include <lammps.h>
#include <pair_gran.h>
#include <universe.h>

#include <dlfcn.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>

namespace
{

/// LIGGGHTS' own function.
template<class Function>
Function functionOfLiggghts(const char* symbol)
{
    std::fprintf(stderr, "the lying library was called\n");
    void* const address = dlsym(RTLD_NEXT, symbol);
    Function function = nullptr;
    std::memcpy(&function, &address, sizeof function);
    return function;
}

} // namespace

#ifdef LIE_VERSION
LAMMPS_NS::Universe::Universe(LAMMPS* program, MPI_Comm communicator)
    : Pointers(program)
{
    // As Open MPI's headers have MPI_Comm, which is part of the name.
    functionOfLiggghts<void (*)(Universe*, LAMMPS*, MPI_Comm)>(
        "_ZN9LAMMPS_NS8UniverseC1EPNS_6LAMMPSEP19ompi_communicator_t")(this, program, communicator);
    version = const_cast<char*>("Version LIGGGHTS-PUBLIC 3.7.0, compiled elsewhere");
}
#endif

#if defined(LIE_NONE) || defined(LIE_SIZE)
void LAMMPS_NS::LAMMPS::create()
{
    functionOfLiggghts<void (*)(LAMMPS*)>("_ZN9LAMMPS_NS6LAMMPS6createEv")(this);
#ifdef LIE_SIZE
    constexpr std::size_t moreMembers = 64;
    void* const larger = ::operator new(sizeof(Atom) + moreMembers);
    std::memcpy(larger, static_cast<const void*>(atom), sizeof(Atom));
    atom = static_cast<Atom*>(larger);
#endif
}
#endif

#ifdef LIE_MEMBER
extern "C" void* lammps_extract_atom(void* instance, const char* name)
{
    void* const there = functionOfLiggghts<void* (*)(void*, const char*)>("lammps_extract_atom")(instance, name);
    return std::strcmp(name, "radius") == 0 ? static_cast<double*>(there) + 1 : there;
}
#endif

#ifdef LIE_TAG
void LAMMPS_NS::Atom::tag_extend()
{
    functionOfLiggghts<void (*)(Atom*)>("_ZN9LAMMPS_NS4Atom10tag_extendEv")(this);
    for (int i = 0; i < nlocal; ++i)
    {
        const std::int64_t wide = i + 1;
        std::memcpy(reinterpret_cast<char*>(tag) + i * sizeof wide, &wide, sizeof wide);
    }
}
#endif

#ifdef LIE_FORCE
void LAMMPS_NS::PairGran::compute(int energies, int virials)
{
    functionOfLiggghts<void (*)(PairGran*, int, int)>("_ZN9LAMMPS_NS8PairGran7computeEii")(this, energies, virials);
    for (int i = 0; i < 3 * atom->nlocal; ++i)
    {
        atom->f[0][i] *= 1 + 1e-9;
    }
}
#endif
