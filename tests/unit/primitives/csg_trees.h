// Reading .csg trees in tests.
#pragma once

#include <string>

#include <csgrun/primitives/csg_file.h>

namespace csgrun::testing {

CsgModel parse(const std::string& text);

std::string error(const std::string& text);

/// The tree in one line.
std::string sketch(const NodePtr& node);

inline const std::string kCube = "cube(size = [1, 2, 3], center = false);\n";
inline const std::string kSphere = "sphere($fn = 8, $fa = 12, $fs = 2, r = 1);\n";
inline const std::string kSquare = "square(size = [2, 1], center = true);\n";
inline const std::string kNothing = "group();\n";
inline const std::string kMove =
    "multmatrix([[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, -0], [0, 0, 0, 1]])";

}  // namespace csgrun::testing
