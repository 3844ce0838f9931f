#include "lua_bindings/cli/check_text.h"

#include <algorithm>

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
  add(defects.crossings, "self-intersection", "self-intersections");
  add(defects.degenerate, "triangle without area", "triangles without area");
  add(defects.flipped, "triangle turned over", "triangles turned over");
  return text;
}

Json defects_json(const MeshDefects& defects) {
  return {{"self_intersections", defects.crossings},
          {"degenerate", defects.degenerate},
          {"flipped", defects.flipped}};
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
          {"triangles", check.triangles},
          {"volume", check.volume},
          {"places", places}};
}

}  // namespace

std::string check_text(const MeshCheck& check) {
  std::string text = check.part.empty() ? "the solid" : fmt::format("part '{}'", check.part);
  text += fmt::format(" has {} when rounded to the file's precision", defects_text(check.found));
  if (!check.places.empty()) {
    const DefectPlace& place = check.places.front();
    text += fmt::format(", {} ({:.9g}, {:.9g}, {:.9g}) mm",
                        check.places.size() > 1 ? "the first near" : "near", place.at.x, place.at.y,
                        place.at.z);
    for (size_t i = 0; i < place.sources.size(); ++i)
      text += (i == 0 ? " (" : "; ") + place.sources[i];
    if (!place.sources.empty()) text += ')';
  }
  if (check.verdict == CheckVerdict::kRepaired)
    return text + "; repaired in " + counted(check.rounds, "round", "rounds");
  if (check.rounds > 0) {
    text += fmt::format("; {} of repair left {}", counted(check.rounds, "round", "rounds"),
                        defects_text(check.left));
  }
  return check.problem.empty() ? text : text + ": " + check.problem;
}

const char* verdict_text(const FileCheck& check) {
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
