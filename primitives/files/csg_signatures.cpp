#include "primitives/files/csg_signatures.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "primitives/base/text.h"
#include "primitives/files/formats.h"

namespace csgrun {
namespace {

struct Signature {
  std::string_view node;
  std::vector<std::string_view> in_order;  ///< what values without a name stand for
  std::vector<std::string_view> by_name;   ///< what only a name can give
};

const std::vector<Signature>& signatures() {
  static const std::vector<Signature> all{
      {"cube", {"size", "center"}, {}},
      {"sphere", {"r", "d"}, {}},
      {"cylinder", {"h", "r1", "r2", "center", "r", "d", "d1", "d2"}, {}},
      {"polyhedron", {"points", "faces", "convexity"}, {}},
      {"square", {"size", "center"}, {}},
      {"circle", {"r", "d"}, {}},
      {"polygon", {"points", "paths", "convexity"}, {}},
      {"text",
       {"text", "size", "font"},
       {"direction", "language", "script", "halign", "valign", "spacing"}},
      {"import",
       {"file"},
       {"id", "layer", "origin", "dpi", "scale", "center", "convexity", "timestamp"}},
      {"surface", {"file", "center", "convexity"}, {"invert", "timestamp"}},
      {"multmatrix", {"m"}, {}},
      {"color", {"c"}, {}},
      {"union", {}, {}},
      {"difference", {}, {}},
      {"intersection", {}, {}},
      {"group", {}, {}},
      {"hull", {}, {}},
      {"fill", {}, {}},
      {"render", {"convexity"}, {}},
      {"minkowski", {"convexity"}, {}},
      {"resize", {"newsize", "auto", "convexity"}, {}},
      {"offset", {"r", "delta", "chamfer"}, {}},
      {"projection", {"cut", "convexity"}, {}},
      {"linear_extrude",
       {"height"},
       {"v", "scale", "center", "twist", "slices", "segments", "convexity"}},
      {"rotate_extrude", {"angle"}, {"start", "convexity"}},
      {"roof", {"method", "convexity"}, {}},
  };
  return all;
}

/// Names that OpenSCAD had before, or has beside those that it writes.
std::string_view name_that_is_read(std::string_view node, std::string_view name) {
  if (node == "polyhedron" && name == "triangles") return "faces";
  if (node == "linear_extrude" && name == "h") return "height";
  if (node == "rotate_extrude" && name == "a") return "angle";
  return name;
}

bool contains(const std::vector<std::string_view>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

void name_arguments(CsgCall& call, std::vector<std::string>& warnings) {
  const auto signature = std::find_if(signatures().begin(), signatures().end(),
                                      [&](const Signature& s) { return s.node == call.name; });
  if (signature == signatures().end()) return;
  std::vector<std::pair<std::string, CsgValue>> named;
  const auto given = [&](std::string_view name) {
    return std::find_if(named.begin(), named.end(), [&](const auto& a) { return a.first == name; });
  };
  size_t place = 0, too_many = 0;
  for (auto& [written, value] : call.arguments) {
    if (written.empty()) {
      const auto& names = signature->in_order;
      while (place < names.size() && given(names[place]) != named.end()) ++place;
      if (place == names.size()) {
        ++too_many;
      } else {
        named.emplace_back(names[place++], std::move(value));
      }
      continue;
    }
    const std::string name(name_that_is_read(call.name, written));
    if (name[0] != '$' && !contains(signature->in_order, name) &&
        !contains(signature->by_name, name)) {
      warnings.push_back(call.name + ": there is no argument " + quoted(written) +
                         ", it was left out");
      continue;
    }
    const auto before = given(name);
    if (before == named.end()) {
      named.emplace_back(name, std::move(value));
      continue;
    }
    warnings.push_back(call.name + ": " + name + " is given twice, the last one counts");
    before->second = std::move(value);
  }
  if (too_many > 0) {
    warnings.push_back(call.name + ": " + std::to_string(too_many) +
                       (too_many == 1 ? " value without a name is" : " values without a name are") +
                       " too many and left out");
  }
  call.arguments = std::move(named);
}

std::optional<CsgCall> take_import(CsgCall& extrusion) {
  const bool linear = extrusion.name == "linear_extrude";
  if (!linear && extrusion.name != "rotate_extrude") return std::nullopt;
  const CsgValue* file = extrusion.find("file");
  if (file == nullptr || (file->kind == CsgValue::Kind::kString && file->string.empty()))
    return std::nullopt;
  CsgCall import;
  import.name = "import";
  import.line = extrusion.line;
  std::vector<std::pair<std::string, CsgValue>> rest;
  for (auto& [name, value] : extrusion.arguments) {
    const bool moves = name == "file" || name == "layer" || name == "origin" ||
                       name == "timestamp" || (name == "scale" && !linear);
    if (!moves) rest.emplace_back(name, value);
    if (name == "scale" && value.kind == CsgValue::Kind::kList && !value.list.empty()) {
      import.arguments.emplace_back(name, value.list[0]);
    } else if (moves || name == "scale" || name[0] == '$') {
      import.arguments.emplace_back(name, std::move(value));
    }
  }
  extrusion.arguments = std::move(rest);
  return import;
}

void add_facets(CsgCall& call, const Facets& facets) {
  const auto add = [&](const char* name, double number, double usual) {
    if (number == usual || call.find(name) != nullptr) return;
    CsgValue value;
    value.kind = CsgValue::Kind::kNumber;
    value.number = number;
    call.arguments.emplace_back(name, value);
  };
  const Facets usual;
  add("$fn", facets.fn, usual.fn);
  add("$fa", facets.fa, usual.fa);
  add("$fs", facets.fs, usual.fs);
}

void clamp_facets(CsgCall& call, std::vector<std::string>& warnings) {
  constexpr double kLeast = 0.01;
  for (auto& [name, value] : call.arguments) {
    if ((name != "$fa" && name != "$fs") || value.kind != CsgValue::Kind::kNumber) continue;
    if (!(value.number < kLeast)) continue;
    warnings.push_back(call.name + ": " + name + " must be at least " + number_text(kLeast) +
                       ", which was taken for " + number_text(value.number));
    value.number = kLeast;
  }
}

bool takes_children(std::string_view node) {
  constexpr std::string_view kLeaves[] = {"cube",   "sphere",  "cylinder", "polyhedron", "square",
                                          "circle", "polygon", "text",     "import",     "surface"};
  return std::find(std::begin(kLeaves), std::end(kLeaves), node) == std::end(kLeaves);
}

}  // namespace csgrun
