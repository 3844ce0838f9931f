#include "primitives/files/svg_notes.h"

namespace csgrun {

void SvgNotes::leave_out(const pugi::xml_node& node, const std::string& what,
                         const std::string& why) {
  Entry& entry = entries_[what];
  if (entry.count++ == 0) {
    entry.place = lines_.of(node);
    entry.why = why;
  }
}

std::vector<std::string> SvgNotes::texts(const std::string& name) const {
  std::vector<std::string> texts;
  for (const auto& [what, entry] : entries_) {
    std::string text = name + ": " + what + " left out (" + std::to_string(entry.count);
    if (!entry.place.empty())
      text += std::string(entry.count > 1 ? ", first" : ",") + " in " + entry.place;
    if (!entry.why.empty()) text += ": " + entry.why;
    texts.push_back(text + ")");
  }
  return texts;
}

}  // namespace csgrun
