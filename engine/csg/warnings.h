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
    const std::string place = where.text();
    std::string line = place.empty() ? text : place + ": " + text;
    if (known_.insert(line).second) lines_.push_back(std::move(line));
  }
  [[nodiscard]] const std::vector<std::string>& lines() const { return lines_; }

 private:
  std::vector<std::string> lines_;
  std::unordered_set<std::string> known_;
};

}  // namespace csgrun
