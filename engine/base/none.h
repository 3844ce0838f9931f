// The index of nothing.
#pragma once

#include <cstdint>

namespace csgrun {

constexpr uint32_t kNone = UINT32_MAX;

}  // namespace csgrun
