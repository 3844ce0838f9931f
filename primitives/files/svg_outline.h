// The outlines of the basic shapes and paths of SVG, in user units.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <pugixml.hpp>

#include "primitives/files/flat_curves.h"
#include "primitives/files/svg_style_sheet.h"
#include "primitives/files/svg_units.h"

namespace csgrun {

/// The lengths of an element: attributes, and properties of CSS where SVG 2 has them as such.
class SvgLengths {
 public:
  SvgLengths(const pugi::xml_node& node, const SvgElementStyle& own, const SvgUnits& units)
      : node_(node), own_(own), units_(units) {}

  /// In user units. Nothing where it is not given, or `auto`, and where it is at fault.
  std::optional<double> find(const char* name);
  double get(const char* name, double otherwise = 0) { return find(name).value_or(otherwise); }

  struct Fault {
    std::string name;  ///< of the attribute
    std::string why;   ///< what stands there, and what was expected
  };
  /// The first that could not be read.
  [[nodiscard]] const std::optional<Fault>& fault() const { return fault_; }

 private:
  pugi::xml_node node_;
  const SvgElementStyle& own_;
  const SvgUnits& units_;
  std::optional<Fault> fault_;
};

struct SvgOutline {
  bool known = true;  ///< whether it is an element that has an outline
  std::vector<Chain> chains;
  std::string damage;  ///< what stands where the rest could not be read; empty: all is well
};

/// Lengths that are at fault are for the caller to ask of `lengths`.
SvgOutline svg_outline(const pugi::xml_node& node, const std::string& kind,
                       const SvgElementStyle& own, SvgLengths& lengths, const SvgSteps& steps);

/// Of all of them together.
double svg_length_of(const std::vector<Chain>& chains);

}  // namespace csgrun
