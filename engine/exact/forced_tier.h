// Which tier decides a sign is no matter for any result. Tests turn the fast ones off to show it.
#pragma once

namespace csgrun {

/// -1: every sign is decided by the cheapest tier that can. 0 to 5 (an index into kTierBits):
/// planes that are made from now on have no double filter, and exact signs take no narrower
/// integers. For tests; to be changed only while nothing is evaluated.
inline int forced_tier = -1;

}  // namespace csgrun
