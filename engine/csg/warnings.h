// Notes for the user: each once, in the order in which they came up.
#pragma once

#include <algorithm>
#include <cstddef>
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
  [[nodiscard]] size_t count() const { return all_.size(); }
  /// Takes those back that came up since there were `count`, about that place, and begin so.
  void take_back(size_t count, const SourceRef& where, const std::string& beginning) {
    const auto is_meant = [&](const Warning& warning) {
      return warning.where.text() == where.text() && warning.text.starts_with(beginning) &&
             known_.erase(where.text() + ": " + warning.text) > 0;
    };
    all_.erase(
        std::remove_if(all_.begin() + static_cast<std::ptrdiff_t>(count), all_.end(), is_meant),
        all_.end());
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
