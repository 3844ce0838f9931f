// Where the tests find files of the checkout, and what may lie beside it.
#pragma once

#include <filesystem>

namespace csgrun::test {

/// The root of the checkout, as the build knows it: __FILE__ may be relative.
std::filesystem::path source_folder();

/// The folder of models beside the checkout, or what CSGRUN_SHARED names; it need not be there.
std::filesystem::path shared_folder();

}  // namespace csgrun::test
