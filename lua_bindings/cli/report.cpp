#include "lua_bindings/cli/report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lua_bindings/cli/check_text.h"

namespace csgrun {
namespace {

using Json = nlohmann::ordered_json;

PartMeasures measures_of(const Part& part) {
  const Solid& solid = *part.solid;
  const Measures& m = solid.measures;
  return {part.name,
          solid.triangles.size(),
          solid.positions.size(),
          m.volume,
          m.area,
          m.bbox,
          m.components,
          m.genus,
          m.closed};
}

Json to_json(const PartMeasures& part) {
  Json box = nullptr;  // nothing has no box
  if (part.triangles > 0) {
    box = Json::array();
    for (const glm::dvec3& corner : part.bbox) box.push_back({corner.x, corner.y, corner.z});
  }
  return {{"name", part.name},
          {"triangles", part.triangles},
          {"vertices", part.vertices},
          {"volume", part.volume},
          {"area", part.area},
          {"bbox", box},
          {"components", part.components},
          {"genus", part.genus},
          {"closed", part.closed}};
}

std::string to_text(const PartMeasures& part) {
  std::string text =
      fmt::format("{}: {} triangles, {} vertices, volume {:.10g} mm^3, area {:.10g} mm^2\n",
                  part.name, part.triangles, part.vertices, part.volume, part.area);
  if (part.triangles > 0) {
    const auto &low = part.bbox[0], &high = part.bbox[1];
    text += fmt::format("  from ({:.10g}, {:.10g}, {:.10g}) to ({:.10g}, {:.10g}, {:.10g}) mm\n",
                        low.x, low.y, low.z, high.x, high.y, high.z);
  }
  return text + fmt::format("  {} component{}, genus {}, {}\n", part.components,
                            part.components == 1 ? "" : "s", part.genus,
                            part.closed ? "closed" : "NOT CLOSED");
}

}  // namespace

std::string stats_json(const RunReport& report) {
  const EvaluateStats& s = report.stats;
  Json parts = Json::array();
  for (const Part& part : report.parts) {
    Json json = to_json(measures_of(part));
    const auto& hash = part.solid->canonical_hash;
    json["faces"] = part.solid->faces.size();
    json["hash"] = fmt::format("{:016x}{:016x}", hash[0], hash[1]);
    parts.push_back(json);
  }
  for (const FlatResult& part : report.flat_parts) parts.push_back(flat_json(part));
  Json json = {{"version", CSGRUN_VERSION},
               {"threads", report.threads},
               {"grid_mm", s.grid_mm},
               {"seconds",
                {{"script", report.script_seconds},
                 {"leaves", s.leaf_seconds},
                 {"boolean", s.boolean_seconds},
                 {"export", report.export_seconds},
                 {"total", report.total_seconds}}},
               {"nodes",
                {{"evaluated", s.nodes_evaluated},
                 {"memory", s.nodes_from_memory},
                 {"disk", s.nodes_from_disk}}},
               {"parts", parts},
               {"warnings", report.warnings},
               {"counters",
                {{"cells", s.cells},
                 {"surface_cells", s.surface_cells},
                 {"critical_cells", s.critical_cells},
                 {"sign_filter", s.sign_filter},
                 {"sign_symbolic", s.sign_symbolic},
                 {"sign_exact", s.sign_exact}}}};
  if (!report.checks.empty()) json["check"] = check_json(report.checks);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string stats_text(const RunReport& report) {
  const EvaluateStats& s = report.stats;
  std::string text;
  for (const Part& part : report.parts) text += to_text(measures_of(part));
  for (const FlatResult& part : report.flat_parts) text += flat_text(part);
  for (const FileCheck& check : report.checks)
    text += fmt::format("{}: check: {}\n", check.file, verdict_text(check));
  text += fmt::format(
      "seconds: script {:.3f}, leaves {:.3f}, boolean {:.3f}, export {:.3f}, total {:.3f}\n",
      report.script_seconds, s.leaf_seconds, s.boolean_seconds, report.export_seconds,
      report.total_seconds);
  text += fmt::format(
      "grid {:.6g} mm; nodes: {} evaluated, {} from memory, {} from disk; {} thread{}\n", s.grid_mm,
      s.nodes_evaluated, s.nodes_from_memory, s.nodes_from_disk, report.threads,
      report.threads == 1 ? "" : "s");
  return text;
}

std::string info_json(const std::string& file, const std::vector<PartMeasures>& parts,
                      const CountedCrossings& crossings, const std::vector<std::string>& warnings) {
  Json list = Json::array();
  for (const PartMeasures& part : parts) list.push_back(to_json(part));
  Json json = {{"file", file}, {"parts", list}, {"self_intersections", crossings.count}};
  if (crossings.at_least) json["at_least"] = true;
  json["warnings"] = warnings;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string info_text(const std::string& file, const std::vector<PartMeasures>& parts,
                      const CountedCrossings& crossings, const std::vector<std::string>& warnings) {
  std::string text = file + "\n";
  for (const PartMeasures& part : parts) text += to_text(part);
  text += fmt::format("{}{} self-intersections\n", crossings.at_least ? "at least " : "",
                      crossings.count);
  for (const std::string& warning : warnings) text += "warning: " + warning + "\n";
  return text;
}

}  // namespace csgrun
