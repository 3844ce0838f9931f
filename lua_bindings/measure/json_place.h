// A value within a JSON document that knows where it stands, so that errors can say so.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace csgrun {

/// What is wrong with a file that is read, without its name.
struct Malformed {
  std::string what;
};

/// Every access checks the type and throws Malformed: "nodes[3].mesh must be a whole number from 0
/// on, it is a string".
class JsonPlace {
 public:
  using Json = nlohmann::json;
  JsonPlace(const Json& json, std::string path) : json_(&json), path_(std::move(path)) {}

  [[nodiscard]] bool has(const char* key) const { return object().contains(key); }
  [[nodiscard]] JsonPlace at(const char* key) const {
    const auto found = object().find(key);
    if (found == json_->end()) throw Malformed{name() + " has no \"" + key + "\""};
    return {*found, path_.empty() ? key : path_ + "." + key};
  }
  [[nodiscard]] JsonPlace at(size_t index) const {
    if (index >= size()) {
      throw Malformed{name() + " has " + std::to_string(size()) + " entries, none of number " +
                      std::to_string(index) + " (from 0)"};
    }
    return {(*json_)[index], path_ + "[" + std::to_string(index) + "]"};
  }
  /// The length of a list.
  [[nodiscard]] size_t size() const {
    require(json_->is_array(), "a list");
    return json_->size();
  }
  /// An index or a count. The library would cast anything.
  [[nodiscard]] size_t whole() const {
    require(json_->is_number_unsigned(), "a whole number from 0 on");
    return json_->get<size_t>();
  }
  [[nodiscard]] double number() const {
    require(json_->is_number(), "a number");
    return json_->get<double>();
  }
  [[nodiscard]] std::string text() const {
    require(json_->is_string(), "a string");
    return json_->get<std::string>();
  }
  [[nodiscard]] size_t whole(const char* key, size_t otherwise) const {
    return has(key) ? at(key).whole() : otherwise;
  }
  [[nodiscard]] std::string text(const char* key, const char* otherwise) const {
    return has(key) ? at(key).text() : otherwise;
  }
  [[nodiscard]] bool truth(const char* key, bool otherwise) const {
    if (!has(key)) return otherwise;
    const JsonPlace value = at(key);
    value.require(value.json_->is_boolean(), "true or false");
    return value.json_->get<bool>();
  }
  /// A list of indices; none when it is not there.
  [[nodiscard]] std::vector<size_t> indices(const char* key) const {
    std::vector<size_t> result;
    if (!has(key)) return result;
    const JsonPlace list = at(key);
    for (size_t i = 0; i < list.size(); ++i) result.push_back(list.at(i).whole());
    return result;
  }
  /// As many numbers as there are in `otherwise`.
  [[nodiscard]] std::vector<double> numbers(const char* key, std::vector<double> otherwise) const {
    if (!has(key)) return otherwise;
    const JsonPlace list = at(key);
    bool fits = list.json_->is_array() && list.json_->size() == otherwise.size();
    for (size_t i = 0; fits && i < otherwise.size(); ++i) {
      const Json& entry = (*list.json_)[i];
      fits = entry.is_number();
      if (fits) otherwise[i] = entry.get<double>();
    }
    list.require(fits, "a list of " + std::to_string(otherwise.size()) + " numbers");
    return otherwise;
  }
  [[nodiscard]] std::string name() const { return path_.empty() ? "the document" : path_; }

 private:
  const Json& object() const {
    require(json_->is_object(), "an object");
    return *json_;
  }
  void require(bool fits, const std::string& wanted) const {
    if (fits) return;
    const std::string kind = json_->is_object()    ? "an object"
                             : json_->is_array()   ? "a list"
                             : json_->is_string()  ? "a string"
                             : json_->is_number()  ? "the number " + json_->dump()
                             : json_->is_boolean() ? json_->dump()
                                                   : "null";
    throw Malformed{name() + " must be " + wanted + ", it is " +
                    (kind == "a list" && wanted.starts_with("a list") ? "another one" : kind)};
  }

  const Json* json_;
  std::string path_;
};

}  // namespace csgrun
