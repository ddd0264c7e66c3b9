#pragma once

namespace clepsydra
{

/// First element of a LIGGGHTS array of rows, which LIGGGHTS allocates in one block.
template<class T>
T* firstElement(T** rows)
{
    return rows ? rows[0] : nullptr;
}

} // namespace clepsydra
