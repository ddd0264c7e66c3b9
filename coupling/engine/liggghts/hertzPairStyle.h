#pragma once

namespace clepsydra
{

/// Replaces LIGGGHTS' evaluation of `pair_style gran model hertz tangential history`, also with `rolling_friction cdt`, by a
/// faster one with the same forces. Call when LIGGGHTS has started, before the script's pair_style.
void registerHertzPairStyle();

} // namespace clepsydra
