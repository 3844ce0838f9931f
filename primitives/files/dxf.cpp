// DXF: entities become chains on a grid of 1/1024.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <glm/geometric.hpp>

#include <csgrun/primitives/flat_file.h>
#include <csgrun/primitives/trig.h>

#include "primitives/base/text.h"
#include "primitives/files/drawn_shape.h"
#include "primitives/files/dxf_loops.h"
#include "primitives/files/dxf_records.h"
#include "primitives/files/flat_curves.h"
#include "primitives/files/flat_formats.h"
#include "primitives/files/formats.h"

namespace csgrun {
namespace {

constexpr int kDeepestInsert = 16;
constexpr size_t kMostEntities = 200000;  // those of a block count for each time it is inserted

struct Placement {
  glm::dvec2 u{1, 0}, v{0, 1}, at{0, 0};
  [[nodiscard]] glm::dvec2 apply(const glm::dvec2& p) const { return p.x * u + p.y * v + at; }
};

class DxfReader {
 public:
  DxfReader(const std::string& name, const FlatFileOptions& options, const DxfRecords& records)
      : name_(name), options_(options), records_(records) {}

  Result<FlatFile> read() {
    Placement placement;
    placement.u *= options_.scale;
    placement.v *= options_.scale;
    placement.at = -options_.scale * options_.origin;
    if (auto status = entities(records_.entities, placement, "", 0); !status) return status.error();
    FlatFile file;
    file.notes = records_.notes;
    if (options_.layer && !found_layer_) {
      const std::string none = name_ + ": there is no layer " + csgrun::quoted(*options_.layer);
      if (!options_.as_openscad) return invalid_argument(none);
      file.notes.push_back(none);
    }
    for (auto& [layer, chains] : chains_) {
      const std::vector<Shape2D::Loop> loops = join_to_loops(chains, options_.as_openscad, open_);
      Result<Shape2D> shape = drawn_shape(loops, FillRule::kEvenOdd);
      if (!shape) return Error{shape.error().code, name_ + ": " + shape.error().message, {}};
      if (!options_.parts) {
        file.shape = *std::move(shape);
      } else if (!shape->empty()) {
        file.parts.push_back({layer, *std::move(shape)});
      }
    }
    for (const auto& [kind, count] : left_out_) {
      file.notes.push_back(name_ + ": " + kind + " left out (" + std::to_string(count) + ")");
    }
    if (open_.count > 0) {
      file.notes.push_back(
          name_ + ": " + std::to_string(open_.count) +
          (open_.count == 1 ? " line is not closed, its" : " lines are not closed, their") +
          " ends were joined; the first begins at (" + number_text(open_.first.x) + ", " +
          number_text(open_.first.y) + ")");
    }
    if (tilted_ > 0) {
      file.notes.push_back(name_ + ": " + std::to_string(tilted_) +
                           (tilted_ == 1 ? " entity lies" : " entities lie") +
                           " in a plane that is not level (line " + std::to_string(first_tilted_) +
                           "); taken as if in the drawing's");
    }
    return file;
  }

 private:
  /// Whether what is given in coordinates of the entity's own is seen from behind: then its X axis
  /// runs to the left (by the arbitrary axis algorithm, for the extrusion direction 0, 0, -1).
  bool is_seen_from_behind(const DxfRecord& r) {
    constexpr double kLevel = 1e-9;
    const double up = r.number(230, 1);
    if (std::max(std::fabs(r.number(210)), std::fabs(r.number(220))) <= kLevel * std::fabs(up))
      return up < 0;
    if (tilted_++ == 0) first_tilted_ = r.line;
    return false;
  }

  static void mirror(Chain& chain) {
    for (glm::dvec2& p : chain.points) p.x = -p.x;
  }

  static glm::dvec2 point(const DxfRecord& r, int x_code) {
    return {r.number(x_code), r.number(x_code + 10)};
  }

  Status count_entity() {
    if (++entities_ <= kMostEntities) return std::monostate();
    return Error{ErrorCode::kLimit,
                 name_ + ": unfolds to more than " + std::to_string(kMostEntities) + " entities",
                 {}};
  }

  Status entities(const std::vector<DxfRecord>& list, const Placement& placement,
                  const std::string& block_layer, int depth) {
    for (size_t i = 0; i < list.size(); ++i) {
      const DxfRecord& r = list[i];
      if (auto status = count_entity(); !status) return status;
      // What is on layer 0 of a block is on the layer of its insertion.
      std::string layer = r.text(8);
      if (layer.empty()) layer = "0";
      if (layer == "0" && !block_layer.empty()) layer = block_layer;
      const bool wanted = !options_.layer || layer == *options_.layer;
      if (options_.parts) layer_ = layer;
      if (wanted) found_layer_ = true;
      const char* hidden = hidden_as(r, depth);
      if (hidden != nullptr) {
        while (r.kind == "POLYLINE" && i + 1 < list.size() && list[i + 1].kind == "VERTEX") ++i;
        if (wanted && shows_something(r)) ++left_out_[hidden];
        continue;
      }
      if (r.kind == "INSERT") {
        if (auto status = insert(r, placement, layer, depth); !status) return status;
        continue;
      }
      if (r.kind == "POLYLINE") {
        const size_t first = i + 1;
        while (i + 1 < list.size() && list[i + 1].kind == "VERTEX") ++i;
        if (wanted) polyline(r, list, first, i + 1, placement, depth > 0);
      } else if (wanted) {
        draw(r, placement, depth > 0);
      }
      if (points_ > kMostDrawingPoints) {
        return Error{
            ErrorCode::kLimit,
            name_ + ": unfolds to more than " + std::to_string(kMostDrawingPoints) + " points",
            {}};
      }
    }
    return std::monostate();
  }

  static bool shows_something(const DxfRecord& r) {
    return r.kind != "SEQEND" && r.kind != "POINT" && r.kind != "VIEWPORT";
  }

  /// A name for entities like this if the drawing does not show them: what is on a sheet of paper
  /// is no part of the model. OpenSCAD knows no difference.
  [[nodiscard]] const char* hidden_as(const DxfRecord& r, int depth) const {
    if (options_.as_openscad) return nullptr;
    if (r.number(60) != 0) return "invisible entities";
    const bool in_block = depth > 0;  // which is where it is inserted
    return !in_block && r.number(67) != 0 ? "entities in paper space" : nullptr;
  }

  Status insert(const DxfRecord& r, const Placement& outer, const std::string& layer, int depth) {
    const auto block = records_.blocks.find(r.text(2));
    if (block == records_.blocks.end()) {
      ++left_out_["INSERT of a block that is not there"];
      return std::monostate();
    }
    if (depth >= kDeepestInsert) {
      return Error{ErrorCode::kLimit,
                   name_ + ":" + std::to_string(r.line) + ": blocks are nested deeper than " +
                       std::to_string(kDeepestInsert) + " (does one contain itself?)",
                   {}};
    }
    const double c = cos_deg(r.number(50)), s = sin_deg(r.number(50));
    const double sx = r.number(41, 1), sy = r.number(42, 1);
    const double side = is_seen_from_behind(r) ? -1 : 1;
    const auto count = [&](int code) { return std::clamp(r.number(code, 1), 1.0, 1e6); };
    for (double row = 0; row < count(71); ++row) {
      for (double column = 0; column < count(70); ++column) {
        const glm::dvec2 step(column * r.number(44), row * r.number(45));
        Placement inner;
        inner.u = glm::dvec2(c, s) * sx;
        inner.v = glm::dvec2(-s, c) * sy;
        inner.at = point(r, 10) + glm::dvec2(c * step.x - s * step.y, s * step.x + c * step.y) -
                   block->second.x * inner.u - block->second.y * inner.v;
        for (glm::dvec2* axis : {&inner.u, &inner.v, &inner.at}) axis->x *= side;
        Placement total;
        total.at = outer.apply(inner.at);
        total.u = outer.apply(inner.u) - outer.at;
        total.v = outer.apply(inner.v) - outer.at;
        if (auto status = count_entity(); !status) return status;  // blocks may be empty
        if (auto status = entities(block->second.entities, total, layer, depth + 1); !status)
          return status;
      }
    }
    return std::monostate();
  }

  /// Also the points of a block are on the grid before they are placed.
  void add(Chain chain, const Placement& placement, bool in_block) {
    for (glm::dvec2& p : chain.points) {
      if (in_block) p = grid_.aligned(p);
      p = grid_.aligned(placement.apply(p));
    }
    points_ += chain.points.size();
    auto& points = chain.points;
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (chain.points.size() > 1) chains_of_layer().push_back(std::move(chain));
  }

  std::vector<Chain>& chains_of_layer() {
    const auto [known, is_new] = place_of_layer_.try_emplace(layer_, chains_.size());
    if (is_new) chains_.emplace_back(layer_, std::vector<Chain>());
    return chains_[known->second].second;
  }

  void draw(const DxfRecord& r, const Placement& placement, bool in_block) {
    const std::string& kind = r.kind;
    // An arc of one unit of radius is so large in the drawing.
    const double scale =
        std::sqrt(std::fabs(placement.u.x * placement.v.y - placement.u.y * placement.v.x));
    Chain chain;
    if (kind == "LINE") {
      chain.points = {point(r, 10), point(r, 11)};
    } else if (kind == "CIRCLE" || kind == "ARC") {
      const double radius = r.number(40);
      if (!(radius > 0)) return;
      double sweep = 360;
      if (kind == "ARC") {
        sweep = std::fmod(r.number(51) - r.number(50), 360);
        if (sweep <= 0) sweep += 360;
        if (!std::isfinite(sweep)) return;
      }
      chain.closed = sweep == 360;
      append_ellipse(point(r, 10), {radius, 0}, {0, radius},
                     kind == "ARC" ? std::fmod(r.number(50), 360) : 0, sweep,
                     options_.facets.fragments(radius * scale, sweep), chain.points);
      if (is_seen_from_behind(r)) mirror(chain);
    } else if (kind == "ELLIPSE") {
      ellipse(r, scale, chain);
    } else if (kind == "LWPOLYLINE") {
      std::vector<Vertex> vertices;
      for (const auto& [code, value] : r.values) {
        DxfRecord one;
        one.values.emplace_back(code, value);
        if (code == 10) vertices.push_back({{one.number(10), 0}, 0});
        if (code == 20 && !vertices.empty()) vertices.back().at.y = one.number(20);
        if (code == 42 && !vertices.empty()) vertices.back().bulge = one.number(42);
      }
      chain = bulged(vertices, is_closed(r), scale);
      if (is_seen_from_behind(r)) mirror(chain);
    } else if (kind == "SPLINE") {
      spline(r, scale, chain);
    } else {
      if (shows_something(r)) ++left_out_[kind];
      return;
    }
    add(std::move(chain), placement, in_block);
  }

  static int flags(const DxfRecord& r) {
    return static_cast<int>(std::clamp(r.number(70), 0.0, 65535.0));
  }
  static bool is_closed(const DxfRecord& r) { return (flags(r) & 1) != 0; }

  struct Vertex {
    glm::dvec2 at;
    double bulge;
  };

  [[nodiscard]] Chain bulged(const std::vector<Vertex>& vertices, bool closed, double scale) const {
    Chain chain;
    chain.closed = closed;
    if (vertices.empty()) return chain;
    Facets facets = options_.facets;
    facets.fs /= scale;  // the arc is measured before it is scaled
    facets.fe /= scale;
    chain.points.push_back(vertices[0].at);
    const size_t n = vertices.size();
    for (size_t i = 0; i + 1 < n || (closed && i + 1 == n); ++i) {
      append_bulge(vertices[i].at, vertices[(i + 1) % n].at, vertices[i].bulge, facets,
                   chain.points);
    }
    if (closed && chain.points.size() > 1) chain.points.pop_back();
    return chain;
  }

  void polyline(const DxfRecord& r, const std::vector<DxfRecord>& list, size_t first, size_t last,
                const Placement& placement, bool in_block) {
    constexpr int kMesh = 16, kPolyface = 64, kFrame = 16;
    if ((flags(r) & (kMesh | kPolyface)) != 0) {
      ++left_out_[(flags(r) & kMesh) != 0 ? "POLYLINE of a mesh" : "POLYLINE of a polyface mesh"];
      return;
    }
    std::vector<Vertex> vertices;
    for (size_t i = first; i < last; ++i) {
      // The frame of a spline's control points is beside the points of the curve.
      if ((flags(list[i]) & kFrame) == 0)
        vertices.push_back({point(list[i], 10), list[i].number(42)});
    }
    if (vertices.empty() && last > first) {
      ++left_out_["POLYLINE of control points only"];
      return;
    }
    const double scale =
        std::sqrt(std::fabs(placement.u.x * placement.v.y - placement.u.y * placement.v.x));
    Chain chain = bulged(vertices, is_closed(r), scale);
    constexpr int kIn3D = 8;  // its points are in world coordinates
    if ((flags(r) & kIn3D) == 0 && is_seen_from_behind(r)) mirror(chain);
    add(std::move(chain), placement, in_block);
  }

  /// Its centre and its axis are in world coordinates; it runs counter-clockwise as seen from the
  /// side that it looks to.
  void ellipse(const DxfRecord& r, double scale, Chain& chain) {
    constexpr double kDegrees = 180 / 3.14159265358979323846;
    const glm::dvec2 major = point(r, 11);
    const double ratio = r.number(40, 1), radius = std::sqrt(glm::dot(major, major));
    if (!(radius > 0) || !(ratio > 0)) return;
    // Angles are radians here; a hair beside a full turn is a full turn.
    const double given = r.number(41) * kDegrees, from = std::fmod(given, 360);
    double sweep = std::fmod(r.number(42, 2 * 3.14159265358979323846) * kDegrees - given, 360);
    constexpr double kNoise = 1e-6;
    if (sweep <= kNoise) sweep += 360;
    if (sweep > 360 - kNoise) sweep = 360;
    if (!std::isfinite(sweep)) return;
    chain.closed = sweep == 360;
    const double turn = is_seen_from_behind(r) ? -ratio : ratio;
    append_ellipse(point(r, 10), major, turn * glm::dvec2(-major.y, major.x), from, sweep,
                   options_.facets.fragments(radius * std::max(ratio, 1.0) * scale, sweep),
                   chain.points);
  }

  /// By de Boor's algorithm, with weights; each knot span in steps of its own.
  void spline(const DxfRecord& r, double scale, Chain& chain) {
    const auto degree = static_cast<int>(std::clamp(r.number(71, 3), 1.0, 15.0));
    std::vector<double> knots, weights;
    std::vector<glm::dvec2> control;
    for (const auto& [code, value] : r.values) {
      DxfRecord one;
      one.values.emplace_back(code, value);
      if (code == 40) knots.push_back(one.number(40));
      if (code == 41) weights.push_back(one.number(41, 1));
      if (code == 10) control.emplace_back(one.number(10), 0);
      if (code == 20 && !control.empty()) control.back().y = one.number(20);
    }
    const size_t n = control.size();
    const bool sound =
        n > static_cast<size_t>(degree) && knots.size() == n + static_cast<size_t>(degree) + 1 &&
        std::is_sorted(knots.begin(), knots.end()) && (weights.empty() || weights.size() == n);
    if (!sound) {
      ++left_out_["SPLINE without control points and knots"];
      return;
    }
    weights.resize(n, 1);
    double length = 0;
    for (size_t i = 1; i < n; ++i) {
      const glm::dvec2 d = control[i] - control[i - 1];
      length += std::sqrt(glm::dot(d, d));
    }
    const size_t spans = n - static_cast<size_t>(degree);
    const int steps = curve_steps(length * scale / static_cast<double>(spans), options_.facets);
    for (auto k = static_cast<size_t>(degree); k < n; ++k) {
      if (knots[k] == knots[k + 1]) continue;
      for (int i = chain.points.empty() ? 0 : 1; i <= steps; ++i) {
        const double t = knots[k] + (knots[k + 1] - knots[k]) * i / steps;
        chain.points.push_back(spline_point(degree, knots, control, weights, k, t));
      }
      points_ += static_cast<size_t>(steps);
      if (points_ > kMostDrawingPoints) return;
    }
  }

  static glm::dvec2 spline_point(int degree, const std::vector<double>& knots,
                                 const std::vector<glm::dvec2>& control,
                                 const std::vector<double>& weights, size_t span, double t) {
    struct Weighted {
      glm::dvec2 p;
      double w;
    };
    std::vector<Weighted> d;
    const auto p = static_cast<size_t>(degree);
    for (size_t j = 0; j <= p; ++j) {
      const size_t i = j + span - p;
      d.push_back({control[i] * weights[i], weights[i]});
    }
    for (size_t r = 1; r <= p; ++r) {
      for (size_t j = p; j >= r; --j) {
        const double low = knots[j + span - p], high = knots[j + 1 + span - r];
        const double a = high > low ? (t - low) / (high - low) : 0;
        d[j] = {d[j - 1].p * (1 - a) + d[j].p * a, d[j - 1].w * (1 - a) + d[j].w * a};
      }
    }
    return d[p].p / d[p].w;
  }

  const std::string& name_;
  const FlatFileOptions& options_;
  const DxfRecords& records_;
  DxfGrid grid_;
  std::vector<std::pair<std::string, std::vector<Chain>>> chains_;  ///< of each layer
  std::map<std::string, size_t> place_of_layer_;
  std::string layer_;  ///< of what is read; empty for all where no parts are asked for
  std::map<std::string, size_t> left_out_;
  size_t entities_ = 0, points_ = 0, tilted_ = 0, first_tilted_ = 0;
  OpenLines open_;
  bool found_layer_ = false;
};

}  // namespace

Result<FlatFile> parse_dxf(const std::string& name, std::string_view bytes,
                           const FlatFileOptions& options) {
  if (!std::isfinite(options.scale) || options.scale == 0) {
    return invalid_argument("import: scale must be a number other than 0");
  }
  const Result<DxfRecords> records = options.as_openscad ? read_dxf_records_as_openscad(name, bytes)
                                                         : read_dxf_records(name, bytes);
  if (!records) return records.error();
  return DxfReader(name, options, *records).read();
}

}  // namespace csgrun
