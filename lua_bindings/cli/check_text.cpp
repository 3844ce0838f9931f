#include "lua_bindings/cli/check_text.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace csgrun {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(CheckVerdict verdict) {
  switch (verdict) {
    case CheckVerdict::kClean:
      return "clean";
    case CheckVerdict::kRepaired:
      return "repaired";
    case CheckVerdict::kFailed:
      return "failed";
  }
  return "failed";
}

const char* name_of(DefectKind kind) {
  switch (kind) {
    case DefectKind::kCrossing:
      return "self_intersection";
    case DefectKind::kDegenerate:
      return "degenerate";
    case DefectKind::kFlipped:
      return "flipped";
    case DefectKind::kInverted:
      return "inverted";
    case DefectKind::kVanished:
      return "vanished";
  }
  return "self_intersection";
}

std::string counted(uint64_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string defects_text(const MeshDefects& defects) {
  std::string text;
  const auto add = [&](uint64_t count, const char* one, const char* many) {
    if (count == 0) return;
    text += (text.empty() ? "" : ", ") + counted(count, one, many);
  };
  if (defects.crossings >= kMostCrossings) text = "at least ";
  text += defects.crossings > 0
              ? counted(defects.crossings, "self-intersection", "self-intersections")
              : "";
  add(defects.degenerate, "triangle without area", "triangles without area");
  add(defects.flipped, "triangle turned over", "triangles turned over");
  add(defects.inverted, "surface inside out or on the wrong side of another",
      "surfaces inside out or on the wrong side of others");
  return text;
}

Json defects_json(const MeshDefects& defects) {
  Json json = {{"self_intersections", defects.crossings},
               {"degenerate", defects.degenerate},
               {"flipped", defects.flipped},
               {"inverted", defects.inverted}};
  if (defects.crossings >= kMostCrossings) json["at_least"] = true;
  return json;
}

Json mesh_json(const MeshCheck& check) {
  Json places = Json::array();
  for (const DefectPlace& place : check.places) {
    places.push_back({{"kind", name_of(place.kind)},
                      {"at", {place.at.x, place.at.y, place.at.z}},
                      {"sources", place.sources}});
  }
  return {{"name", check.part},
          {"verdict", name_of(check.verdict)},
          {"found", defects_json(check.found)},
          {"left", defects_json(check.left)},
          {"rounds", check.rounds},
          {"moved_vertices", check.moved},
          {"unions", check.unions},
          {"distance", check.distance},
          {"vanished", check.vanished},
          {"thickness", check.thickness},
          {"triangles", check.triangles},
          {"volume", check.volume},
          {"places", places}};
}

/// ", near (1, 2, 3) mm (cube, model.lua:3)"
std::string place_text(const DefectPlace& place, uint64_t count) {
  std::string text =
      fmt::format(", {} ({:.9g}, {:.9g}, {:.9g}) mm", count > 1 ? "the first near" : "near",
                  place.at.x, place.at.y, place.at.z);
  for (size_t i = 0; i < place.sources.size(); ++i)
    text += (i == 0 ? " (" : "; ") + place.sources[i];
  return place.sources.empty() ? text : text + ')';
}

std::string vanished_text(const MeshCheck& check) {
  std::string text = counted(check.vanished, "connected surface", "connected surfaces");
  // Rounded up: thinner than what is said.
  text += fmt::format(" less than {:.3g} mm thick vanished",
                      std::max(check.thickness * 1.01, std::numeric_limits<double>::min()));
  for (const DefectPlace& place : check.places) {
    if (place.kind == DefectKind::kVanished) return text + place_text(place, check.vanished);
  }
  return text;
}

}  // namespace

std::string check_text(const MeshCheck& check) {
  std::string text = check.part.empty() ? "the solid" : fmt::format("part '{}'", check.part);
  if (check.verdict == CheckVerdict::kClean) return text + ": " + vanished_text(check);
  text += fmt::format(" has {} at the coordinates of the file", defects_text(check.found));
  if (!check.places.empty()) {
    text += place_text(check.places.front(), check.found.crossings + check.found.degenerate +
                                                 check.found.flipped + check.found.inverted);
  }
  if (check.verdict == CheckVerdict::kRepaired) {
    text += "; repaired in " + counted(check.rounds, "round", "rounds");
    const auto [rounded, written] = check.volume;
    if (check.triangles[1] > 0 && std::abs(written - rounded) > std::abs(rounded) / 100)
      text += fmt::format(", which took the volume from {:.4g} to {:.4g} mm^3", rounded, written);
    return check.vanished > 0 ? text + "; " + vanished_text(check) : text;
  }
  if (check.rounds > 0) {
    text += fmt::format("; {} of repair left {}", counted(check.rounds, "round", "rounds"),
                        defects_text(check.left));
  }
  return check.problem.empty() ? text : text + ": " + check.problem;
}

const char* verdict_text(const FileCheck& check) {
  if (model_format_of(check.file) == "exact.json") return "exact";  // nothing was rounded
  CheckVerdict worst = CheckVerdict::kClean;
  for (const MeshCheck& mesh : check.meshes) worst = std::max(worst, mesh.verdict);
  return name_of(worst);
}

nlohmann::ordered_json check_json(const std::vector<FileCheck>& checks) {
  Json list = Json::array();
  for (const FileCheck& check : checks) {
    Json meshes = Json::array();
    for (const MeshCheck& mesh : check.meshes) meshes.push_back(mesh_json(mesh));
    list.push_back({{"file", check.file}, {"verdict", verdict_text(check)}, {"parts", meshes}});
  }
  return list;
}

}  // namespace csgrun
