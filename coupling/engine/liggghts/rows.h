#pragma once

namespace clepsydra
{

/// First element of a LIGGGHTS array of rows, which its memory manager allocates in one piece.
template<class T>
T* firstElement(T** rows)
{
    return rows ? rows[0] : nullptr;
}

} // namespace clepsydra
