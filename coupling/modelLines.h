#pragma once

#include "wordList.H"

#include <initializer_list>
#include <map>
#include <string>
#include <utility>

namespace clepsydra
{

/// Names that an entry of a case may have, with a line each on what they mean, for those who ask the program for them
/// (`pimpleDemFoam -listModels`). Stated where the models are, also by libraries of users.
class ModelLines
{
public:
    /// \param entry  as users write it; several objects may add to one
    ModelLines(const std::string& entry, std::initializer_list<std::pair<const char*, const char*>> lines);

    /// Of this object's models, in the order given.
    const Foam::wordList& names() const
    {
        return names_;
    }

    /// entry -> name -> line, of all objects there are.
    static const std::map<std::string, std::map<std::string, std::string>>& all();

private:
    Foam::wordList names_;
};

/// Prints all of them to standard output.
void listModels();

} // namespace clepsydra
