#pragma once

namespace clepsydra
{

/// Puts our evaluation of `pair_style gran model hertz tangential history` in the place of LIGGGHTS' own: the same forces
/// in less time. To be called once LIGGGHTS has started and before the script's pair_style.
void registerHertzPairStyle();

} // namespace clepsydra
