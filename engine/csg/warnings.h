// Notes for the user: each once, in the order in which they came up.
#pragma once

#include <string>
#include <unordered_set>
#include <vector>

#include <csgrun/engine/error.h>

namespace csgrun {

class Warnings {
 public:
  void add(const SourceRef& where, const std::string& text) {
    if (known_.insert(where.text() + ": " + text).second) all_.push_back({where, text});
  }
  /// `place(where)` says where one came up; it may be empty.
  template <class Place>
  [[nodiscard]] std::vector<std::string> lines(Place&& place) const {
    std::vector<std::string> lines;
    for (const auto& [where, text] : all_) {
      const std::string at = place(where);
      lines.push_back(at.empty() ? text : at + ": " + text);
    }
    return lines;
  }

 private:
  struct Warning {
    SourceRef where;
    std::string text;
  };
  std::vector<Warning> all_;
  std::unordered_set<std::string> known_;
};

}  // namespace csgrun
