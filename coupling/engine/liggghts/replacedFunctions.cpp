#include "engine/liggghts/replacedFunctions.h"

#include "engine/demEngine.h"

#include <cxxabi.h>
#include <dlfcn.h>
#include <link.h>

#include <cstdlib>
#include <memory>
#include <set>

namespace clepsydra
{

namespace
{

/// A shared library, or the program, as it lies in memory.
struct LoadedObject
{
    std::string file;
    const void* base = nullptr;
    const link_map* map = nullptr;
};

LoadedObject objectAt(const void* address)
{
    Dl_info info{};
    void* map = nullptr;
    if (dladdr1(address, &info, &map, RTLD_DL_LINKMAP) == 0)
    {
        throw DemEngineError("The dynamic linker knows no library at an address of LIGGGHTS; allowed: LIGGGHTS as a "
                             "shared library");
    }
    return {info.dli_fname, info.dli_fbase, static_cast<const link_map*>(map)};
}

/// An object's dynamic section; 0 for what it does not have.
class DynamicSection
{
public:
    explicit DynamicSection(const LoadedObject& object)
        : object_(object)
    {}

    bool has(ElfW(Sxword) tag) const
    {
        return entry(tag).d_tag == tag;
    }

    ElfW(Xword) value(ElfW(Sxword) tag) const
    {
        return has(tag) ? entry(tag).d_un.d_val : 0;
    }

    template<class T>
    const T* table(ElfW(Sxword) tag) const
    {
        // Already moved to where the object lies, by most C libraries.
        const ElfW(Addr) address = value(tag);
        const ElfW(Addr) moved = address < object_.map->l_addr ? address + object_.map->l_addr : address;
        return reinterpret_cast<const T*>(moved); // NOLINT(performance-no-int-to-ptr)
    }

private:
    /// The last one where there is none of this tag.
    const ElfW(Dyn) & entry(ElfW(Sxword) tag) const
    {
        const ElfW(Dyn)* entry = object_.map->l_ld;
        while (entry->d_tag != DT_NULL && entry->d_tag != tag)
        {
            ++entry;
        }
        return *entry;
    }

    const LoadedObject& object_;
};

/// The functions and data that an object leaves to the dynamic linker to find by name.
std::set<std::string> namesLookedUp(const LoadedObject& object)
{
    std::set<std::string> names;
    const DynamicSection dynamic(object);
    const auto* const symbols = dynamic.table<ElfW(Sym)>(DT_SYMTAB);
    const auto* const texts = dynamic.table<char>(DT_STRTAB);
    const auto add = [&](ElfW(Sxword) first, ElfW(Sxword) size) {
        const auto* const relocations = dynamic.table<ElfW(Rela)>(first);
        const std::size_t count = dynamic.value(size) / sizeof(ElfW(Rela));
        for (std::size_t i = 0; i < count; ++i)
        {
            names.insert(texts + symbols[ELF64_R_SYM(relocations[i].r_info)].st_name);
        }
    };
    add(DT_RELA, DT_RELASZ);
    add(DT_JMPREL, DT_PLTRELSZ);
    return names;
}

/// Looks up names in itself before anything else.
bool prefersItself(const LoadedObject& object)
{
    const DynamicSection dynamic(object);
    return (dynamic.value(DT_FLAGS) & DF_SYMBOLIC) != 0 || dynamic.has(DT_SYMBOLIC);
}

/// As a programmer writes it.
std::string readable(const std::string& symbol)
{
    int status = 0;
    const std::unique_ptr<char, decltype(&std::free)> text(
        abi::__cxa_demangle(symbol.c_str(), nullptr, nullptr, &status), &std::free);
    return status == 0 ? text.get() : symbol;
}

} // namespace

void requireReplaced(const std::vector<std::string>& symbols, const void* inLibrary, const void* inReplacement)
{
    const LoadedObject library = objectAt(inLibrary);
    const LoadedObject replacement = objectAt(inReplacement);
    const std::set<std::string> lookedUp = namesLookedUp(library);
    for (const std::string& symbol : symbols)
    {
        const void* const found = dlsym(RTLD_DEFAULT, symbol.c_str());
        const bool isFirst = found != nullptr && objectAt(found).base == replacement.base;
        if (!isFirst || lookedUp.count(symbol) == 0 || prefersItself(library))
        {
            throw DemEngineError(
                "The library " + library.file + " calls its own " + readable(symbol)
                + ", not this program's, which hands errors on: one would end the run without a word; allowed: a "
                  "library linked without -Bsymbolic and -Bsymbolic-functions, as Debian's libliggghts3 is");
        }
    }
}

} // namespace clepsydra
