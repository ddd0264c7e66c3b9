#include "run/unreadFields.h"

#include "IOobjectList.H"
#include "knownEntries.h"

namespace clepsydra
{

using namespace Foam;

namespace
{

bool isField(const word& type)
{
    return type.ends_with("Field") && (type.starts_with("vol") || type.starts_with("surface"));
}

} // namespace

void reportUnreadFields(const fvMesh& mesh)
{
    wordList read;
    for (const word& name : mesh.sortedNames())
    {
        const regIOobject& object = mesh.lookupObject<regIOobject>(name);
        if (isField(object.type()) && object.readOpt() != IOobject::NO_READ)
        {
            read.append(name);
        }
    }
    const IOobjectList files(mesh, mesh.time().timeName(), "", IOobject::MUST_READ, IOobject::NO_WRITE, false);
    for (const word& name : files.sortedNames())
    {
        if (!Pstream::master() || !isField(files[name]->headerClassName()) || read.found(name))
        {
            continue;
        }
        const std::string file = mesh.time().timeName() + '/' + name;
        const std::string nearest = didYouMean(name, read);
        if (!nearest.empty())
        {
            FatalErrorInFunction << "The field " << file.c_str() << " is not read" << nearest.c_str()
                                 << "; allowed: " << flatOutput(read) << exit(FatalError);
        }
        WarningInFunction << "The field " << file.c_str() << " is not read, unless by a function object"
                          << "; the solver reads " << flatOutput(read) << endl;
    }
}

} // namespace clepsydra
