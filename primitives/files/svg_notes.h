// What is left out of an SVG, counted by its kind, with the line where it is for the first time.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "primitives/files/svg_document.h"

namespace csgrun {

class SvgNotes {
 public:
  explicit SvgNotes(const SvgLines& lines) : lines_(lines) {}

  /// `what` is left out at this element; `why` says more of the first of them.
  void leave_out(const pugi::xml_node& node, const std::string& what, const std::string& why = {});

  /// "line 12", for messages; empty where it is not known.
  [[nodiscard]] std::string place(const pugi::xml_node& node) const { return lines_.of(node); }

  /// "a.svg: <text> left out (2, first in line 7)", in the order of the alphabet.
  [[nodiscard]] std::vector<std::string> texts(const std::string& name) const;

 private:
  struct Entry {
    size_t count = 0;
    std::string place, why;  ///< of the first
  };
  const SvgLines& lines_;
  std::map<std::string, Entry> entries_;
};

}  // namespace csgrun
