#include "engine/liggghts/replacedFunctions.h"

#include "engine/demEngine.h"

#include <cxxabi.h>
#include <dlfcn.h>
#include <link.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <set>
#include <string_view>
#include <unordered_set>

namespace clepsydra
{

namespace
{

/// A shared library or the program, as it is loaded in memory.
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

/// The dynamic section of an object; values that it does not have are 0.
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
        // Most C libraries have already added the load address.
        const ElfW(Addr) address = value(tag);
        const ElfW(Addr) moved = address < object_.map->l_addr ? address + object_.map->l_addr : address;
        return reinterpret_cast<const T*>(moved); // NOLINT(performance-no-int-to-ptr)
    }

private:
    /// The entry with this tag; the last entry where there is none.
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

/// The given functions as far as the object leaves it to the dynamic linker to find them by name.
std::set<std::string_view> lookedUpOf(const std::vector<std::string>& functions, const LoadedObject& object)
{
    const DynamicSection dynamic(object);
    std::vector<bool> isDone; // tables of virtual functions name most symbols many times
    const std::unordered_set<std::string_view> wanted(functions.begin(), functions.end());
    const auto* const symbols = dynamic.table<ElfW(Sym)>(DT_SYMTAB);
    const auto* const texts = dynamic.table<char>(DT_STRTAB);
    std::set<std::string_view> found;
    const auto add = [&](ElfW(Sxword) first, ElfW(Sxword) size) {
        const auto* const relocations = dynamic.table<ElfW(Rela)>(first);
        const std::size_t count = dynamic.value(size) / sizeof(ElfW(Rela));
        for (std::size_t i = 0; i < count; ++i)
        {
            const std::size_t symbol = ELF64_R_SYM(relocations[i].r_info);
            isDone.resize(std::max(isDone.size(), symbol + 1));
            const std::string_view name = isDone[symbol] ? "" : texts + symbols[symbol].st_name;
            isDone[symbol] = true;
            if (wanted.count(name) > 0)
            {
                found.insert(name);
            }
        }
    };
    add(DT_RELA, DT_RELASZ);
    add(DT_JMPREL, DT_PLTRELSZ);
    return found;
}

/// Whether the object looks up names in itself before anywhere else.
bool prefersItself(const LoadedObject& object)
{
    const DynamicSection dynamic(object);
    return (dynamic.value(DT_FLAGS) & DF_SYMBOLIC) != 0 || dynamic.has(DT_SYMBOLIC);
}

/// The name of a symbol as a programmer writes it.
std::string readable(const std::string& symbol)
{
    int status = 0;
    const std::unique_ptr<char, decltype(&std::free)> text(
        abi::__cxa_demangle(symbol.c_str(), nullptr, nullptr, &status), &std::free);
    return status == 0 ? text.get() : symbol;
}

/// Address and size of a function in the dynamic linker's tables.
struct Function
{
    void* address = nullptr;
    std::size_t size = 0;
};

/// The library's own function, whatever other objects have a function of this name.
Function functionOf(const LoadedObject& library, const std::string& symbol)
{
    // The library is loaded already, so this only increases its reference count.
    const auto close = [](void* handle) { dlclose(handle); };
    const std::unique_ptr<void, decltype(close)> handle(dlopen(library.file.c_str(), RTLD_LAZY | RTLD_NOLOAD), close);
    void* const address = handle ? dlsym(handle.get(), symbol.c_str()) : nullptr;
    Dl_info info{};
    void* entry = nullptr;
    if (address == nullptr || dladdr1(address, &info, &entry, RTLD_DL_SYMENT) == 0 || entry == nullptr
        || info.dli_fbase != library.base)
    {
        return {};
    }
    return {address, static_cast<const ElfW(Sym)*>(entry)->st_size};
}

/// Instructions that jump to a function at any distance. They use a register in which no argument is passed.
std::vector<unsigned char> jumpTo(const void* function)
{
#if defined(__x86_64__)
    std::vector<unsigned char> code{0x49, 0xbb, 0, 0, 0, 0, 0, 0, 0, 0, 0x41, 0xff, 0xe3}; // movabs r11; jmp *r11
    std::memcpy(code.data() + 2, &function, sizeof function);
    return code;
#elif defined(__aarch64__)
    std::vector<unsigned char> code{
        0x50, 0, 0, 0x58, 0, 0x02, 0x1f, 0xd6, 0, 0, 0, 0, 0, 0, 0, 0}; // ldr x16, #8; br x16
    std::memcpy(code.data() + 8, &function, sizeof function);
    return code;
#else
    static_cast<void>(function);
    return {};
#endif
}

/// Overwrites the beginning of a library's function by a jump to another function, in this process's copy of the
/// library.
/// \return why that is impossible; empty where it was done
std::string redirect(const Function& from, const void* to)
{
    const std::vector<unsigned char> code = jumpTo(to);
    if (code.empty())
    {
        return "this program has no jump for this kind of processor";
    }
    if (from.size < code.size())
    {
        return "it has " + std::to_string(from.size) + " bytes, and a jump to another function takes "
               + std::to_string(code.size());
    }
    if (std::memcmp(from.address, code.data(), code.size()) == 0)
    {
        return {};
    }
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    const auto address = reinterpret_cast<std::uintptr_t>(from.address);
    const std::uintptr_t begin = address / page * page;
    void* const pages = reinterpret_cast<void*>(begin); // NOLINT(performance-no-int-to-ptr)
    const std::size_t length = address + code.size() - begin;
    // Both writable and executable: where the system forbids this, it does so here, before anything has been changed.
    if (mprotect(pages, length, PROT_READ | PROT_WRITE | PROT_EXEC) != 0)
    {
        return std::string("the system forbids to change it in memory (") + std::strerror(errno) + ")";
    }
    std::memcpy(from.address, code.data(), code.size());
    auto* const first = static_cast<char*>(from.address);
    __builtin___clear_cache(first, first + code.size());
    mprotect(pages, length, PROT_READ | PROT_EXEC);
    return {};
}

} // namespace

std::string fileOfObjectAt(const void* address)
{
    return objectAt(address).file;
}

void replaceFunctions(const std::vector<std::string>& symbols, const void* inLibrary, const void* inReplacement)
{
    const LoadedObject library = objectAt(inLibrary);
    const LoadedObject replacement = objectAt(inReplacement);
    const std::set<std::string_view> lookedUp = lookedUpOf(symbols, library);
    const bool looksElsewhere = !prefersItself(library);
    for (const std::string& symbol : symbols)
    {
        const void* const found = dlsym(RTLD_DEFAULT, symbol.c_str());
        const bool isFirst = found != nullptr && objectAt(found).base == replacement.base;
        if (isFirst && looksElsewhere && lookedUp.count(symbol) > 0)
        {
            continue;
        }
        const Function own = functionOf(library, symbol);
        if (own.address == nullptr)
        {
            throw DemEngineError("The library " + library.file + " has no function " + readable(symbol)
                                 + ", which this program replaces; allowed: LIGGGHTS 3.8");
        }
        const std::string obstacle =
            isFirst ? redirect(own, found) : "a third library has a function of this name, which is found first";
        if (!obstacle.empty())
        {
            throw DemEngineError(
                "The library " + library.file + " calls its own " + readable(symbol)
                + ", not this program's, which reports errors: an error would end the run without a message. It cannot "
                  "be replaced: "
                + obstacle
                + "; allowed: LIGGGHTS linked without -Bsymbolic and -Bsymbolic-functions, as Debian's libliggghts is. "
                  "Ubuntu's is linked with the latter; to build it without, set "
                  "DEB_LDFLAGS_STRIP=-Wl,-Bsymbolic-functions in the environment of apt-get source --build liggghts");
        }
    }
}

} // namespace clepsydra
