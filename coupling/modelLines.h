#pragma once

#include "wordList.H"

#include <initializer_list>
#include <map>
#include <string>
#include <utility>

namespace clepsydra
{

/// Names that an entry of a case may have, each with one line on its meaning, as `pimpleDemFoam -listModels` prints
/// them. They are declared beside the models, also in users' own libraries.
class ModelLines
{
public:
    /// \param entry  the entry as users write it; several objects may add names to one entry
    ModelLines(const std::string& entry, std::initializer_list<std::pair<const char*, const char*>> lines);

    /// Names of this object's models, in the order given.
    const Foam::wordList& names() const
    {
        return names_;
    }

    /// Entry -> name -> line, of all objects in the program.
    static const std::map<std::string, std::map<std::string, std::string>>& all();

private:
    Foam::wordList names_;
};

/// Prints the lines of all models to standard output.
void listModels();

} // namespace clepsydra
