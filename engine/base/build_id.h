// Which build of the kernel this is.
#pragma once

#include <cstddef>
#include <span>

namespace csgrun {

/// What the linker noted of the program or library that holds this code (NT_GNU_BUILD_ID), which
/// differs when the code does. Empty where it notes nothing.
std::span<const std::byte> build_id();

}  // namespace csgrun
