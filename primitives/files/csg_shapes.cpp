#include "primitives/files/csg_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include <csgrun/engine/repair.h>

#include "primitives/base/text.h"
#include "primitives/files/face_colours.h"
#include "primitives/files/formats.h"

namespace csgrun {
namespace {

using Kind = CsgValue::Kind;

bool is_number_list(const CsgValue& value, size_t size) {
  return value.kind == Kind::kList && value.list.size() == size &&
         std::all_of(value.list.begin(), value.list.end(),
                     [](const CsgValue& v) { return v.kind == Kind::kNumber; });
}

std::vector<double> number_list(const CsgValue& value) {
  std::vector<double> numbers;
  for (const CsgValue& v : value.list) numbers.push_back(v.number);
  return numbers;
}

}  // namespace

void CsgArguments::wrong_type(std::string_view name, const std::string& wanted) {
  if (error_) return;
  error_ = Error{
      ErrorCode::kMalformedFile, call_.name + ": " + std::string(name) + " must be " + wanted, {}};
}

void CsgArguments::impossible(std::string_view name, const std::string& wanted) {
  if (error_) return;
  error_ = invalid_argument(call_.name + ": " + std::string(name) + " must be " + wanted);
}

double CsgArguments::number(std::string_view name, double otherwise) {
  const CsgValue* value = call_.find(name);
  if (value == nullptr) return otherwise;
  if (value->kind != Kind::kNumber) wrong_type(name, "a number");
  return value->number;
}

bool CsgArguments::boolean(std::string_view name, bool otherwise) {
  const CsgValue* value = call_.find(name);
  if (value == nullptr) return otherwise;
  if (value->kind != Kind::kBool) wrong_type(name, "true or false");
  return value->boolean;
}

std::string CsgArguments::string(std::string_view name, const std::string& otherwise) {
  const CsgValue* value = call_.find(name);
  if (value == nullptr) return otherwise;
  if (value->kind != Kind::kString) wrong_type(name, "a string");
  return value->string;
}

std::vector<double> CsgArguments::numbers(std::string_view name, size_t size,
                                          std::vector<double> otherwise) {
  const CsgValue* value = call_.find(name);
  if (value == nullptr) return otherwise;
  if (is_number_list(*value, size)) return number_list(*value);
  wrong_type(name, "a list of " + std::to_string(size) + " numbers");
  return otherwise;
}

std::vector<double> CsgArguments::size(std::string_view name, size_t size) {
  const CsgValue* value = call_.find(name);
  if (value != nullptr && value->kind == Kind::kNumber)
    return std::vector<double>(size, value->number);
  return numbers(name, size, std::vector<double>(size, 1));
}

double CsgArguments::radius(std::string_view r, std::string_view d, double otherwise) {
  return has(d) ? number(d, 0) / 2 : number(r, otherwise);
}

std::vector<std::vector<double>> CsgArguments::rows(std::string_view name, size_t row_size) {
  std::vector<std::vector<double>> result;
  const CsgValue* value = call_.find(name);
  if (value == nullptr) return result;
  if (value->kind != Kind::kList) wrong_type(name, "a list");
  for (const CsgValue& row : value->list) {
    if (!is_number_list(row, row_size)) {
      impossible(name, "a list of lists of " + std::to_string(row_size) + " numbers");
      return {};
    }
    result.push_back(number_list(row));
  }
  return result;
}

std::vector<std::vector<uint32_t>> CsgArguments::index_lists(std::string_view name, size_t limit,
                                                             std::vector<std::string>& warnings) {
  std::vector<std::vector<uint32_t>> result;
  const CsgValue* value = call_.find(name);
  if (value == nullptr) return result;
  if (value->kind != Kind::kList) wrong_type(name, "a list");
  for (const CsgValue& entry : value->list) {
    if (!is_number_list(entry, entry.list.size())) {
      impossible(name, "a list of lists of numbers");
      return {};
    }
    std::vector<uint32_t>& indices = result.emplace_back();
    for (const CsgValue& index : entry.list) {
      if (index.number >= 0 && index.number < static_cast<double>(limit)) {
        indices.push_back(static_cast<uint32_t>(index.number));
      } else {
        warnings.push_back(call_.name + ": index " + number_text(index.number) + " in " +
                           std::string(name) + " is out of range, there are " +
                           std::to_string(limit) + " points; it was left out");
      }
    }
  }
  return result;
}

Facets CsgArguments::facets() {
  Facets facets{number("$fn", 0), number("$fa", 12), number("$fs", 2), number("$fe", 0)};
  // As OpenSCAD has it. Sides of any length or angle are as few as there can be.
  if (!std::isfinite(facets.fn)) facets.fn = 3;
  if (facets.fa > 360) facets.fa = 360;
  if (facets.fs > std::numeric_limits<double>::max())
    facets.fs = std::numeric_limits<double>::max();
  if (facets.fn > kMostFacets && !error_) {
    error_ =
        Error{ErrorCode::kLimit,
              call_.name + ": $fn must be at most " +
                  std::to_string(static_cast<int>(kMostFacets)) + ", got " + number_text(facets.fn),
              {}};
  }
  return facets;
}

std::optional<Affine> CsgArguments::matrix() {
  const CsgValue* value = call_.find("m");
  const auto is_row = [](const CsgValue& row) {
    return row.kind == Kind::kList && row.list.size() <= 4 && is_number_list(row, row.list.size());
  };
  const bool good = value != nullptr && value->kind == Kind::kList && value->list.size() <= 4 &&
                    std::all_of(value->list.begin(), value->list.end(), is_row);
  if (!good) {
    wrong_type("its argument", "a matrix of 4 x 4 numbers, or of fewer");
    return std::nullopt;
  }
  // What OpenSCAD writes is whole; what others write may lack entries, which are the identity's.
  double m[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  for (size_t i = 0; i < value->list.size(); ++i) {
    const std::vector<CsgValue>& row = value->list[i].list;
    for (size_t j = 0; j < row.size(); ++j) m[i][j] = row[j].number;
  }
  Affine map;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) map.m[i][j] = m[i][j] / m[3][3];
  }
  return map;
}

Result<PolygonMesh> repaired_or(Result<PolygonMesh> refused, PolygonMesh given,
                                std::vector<std::string>& notes, PolygonMesh* uncut) {
  const Result<RepairOptions> options = suggest_repair(given);
  if (!options || options->fill_holes) return refused;
  std::vector<std::string> steps;
  Result<PolygonMesh> mesh = repair_solid_mesh(std::move(given), *options, &steps, uncut);
  if (!mesh) return refused;
  notes.insert(notes.end(), steps.begin(), steps.end());
  return mesh;
}

bool is_solid_primitive(std::string_view name) {
  return name == "cube" || name == "sphere" || name == "cylinder" || name == "polyhedron";
}

bool is_flat_primitive(std::string_view name) {
  return name == "square" || name == "circle" || name == "polygon";
}

namespace {

/// How many points of a face differ.
size_t different_points(const std::vector<glm::dvec3>& points, const std::vector<uint32_t>& face) {
  std::set<std::tuple<double, double, double>> different;
  for (const uint32_t i : face) different.insert({points[i].x, points[i].y, points[i].z});
  return different.size();
}

MeshResult make_csg_polyhedron(CsgArguments& arguments, std::vector<std::string>& warnings,
                               PolygonMesh& uncut, PolygonMesh* open) {
  std::vector<glm::dvec3> points;
  for (const std::vector<double>& row : arguments.rows("points", 3)) {
    points.emplace_back(row[0], row[1], row[2]);
  }
  if (arguments.error()) return *arguments.error();  // rather than of the indices of no points
  const size_t before = warnings.size();
  std::vector<std::vector<uint32_t>> faces =
      arguments.index_lists("faces", points.size(), warnings);
  if (arguments.error()) return *arguments.error();
  const std::string bad_index = warnings.size() > before ? warnings[before] : "";
  const auto as_given = [&] {
    PolygonMesh given;
    given.kind = "polyhedron";
    given.points = points;
    for (const auto& face : faces)
      given.add_face(std::vector<uint32_t>(face.rbegin(), face.rend()));
    return given;
  };
  std::string note;
  if (open != nullptr) {
    // Of a face that is nothing the points count all the same.
    std::erase_if(faces, [](const std::vector<uint32_t>& face) { return face.size() < 3; });
    MeshResult mesh = make_polyhedron(points, faces, &note, FillRule::kNonZero, &uncut);
    if (!mesh && mesh.error().code == ErrorCode::kInvalidMesh) *open = as_given();
    return mesh;
  }
  // Six digits make short edges vanish; a face of fewer than three different points is then
  // nothing.
  std::erase_if(faces, [&](const std::vector<uint32_t>& face) {
    if (different_points(points, face) >= 3) return false;
    warnings.push_back("polyhedron: a face of fewer than three different points was left out");
    return true;
  });
  MeshResult mesh = make_polyhedron(points, faces, &note, FillRule::kNonZero, &uncut);
  if (!note.empty()) warnings.push_back(note);
  if (!mesh && mesh.error().code == ErrorCode::kInvalidMesh)
    mesh = repaired_or(std::move(mesh), as_given(), warnings, &uncut);
  // Without the index the rest is hardly a solid: what is to be said is the index.
  if (!mesh && !bad_index.empty()) {
    return Error{mesh.error().code, bad_index + ", and then " + mesh.error().message, {}};
  }
  return mesh;
}

}  // namespace

MeshResult make_csg_solid(const CsgCall& call, std::vector<std::string>& warnings,
                          PolygonMesh& uncut, PolygonMesh* open) {
  CsgArguments arguments(call);
  if (call.name == "polyhedron") return make_csg_polyhedron(arguments, warnings, uncut, open);
  const bool center = arguments.boolean("center", false);
  if (call.name == "cube") {
    const std::vector<double> size = arguments.size("size", 3);
    if (arguments.error()) return *arguments.error();
    return make_cube({size[0], size[1], size[2]}, {center, center, center});
  }
  const Facets facets = arguments.facets();
  if (call.name == "sphere") {
    const double r = arguments.radius("r", "d", 1);
    if (arguments.error()) return *arguments.error();
    return make_sphere(r, facets);
  }
  const double r = arguments.radius("r", "d", 1), h = arguments.number("h", 1),
               r1 = arguments.radius("r1", "d1", r), r2 = arguments.radius("r2", "d2", r);
  if (arguments.error()) return *arguments.error();
  return make_cylinder(h, r1, r2, center, facets);
}

Result<Shape2D> make_csg_shape(const CsgCall& call, std::vector<std::string>& warnings) {
  CsgArguments arguments(call);
  if (call.name == "square") {
    const std::vector<double> size = arguments.size("size", 2);
    const bool center = arguments.boolean("center", false);
    if (arguments.error()) return *arguments.error();
    return make_square({size[0], size[1]}, {center, center});
  }
  if (call.name == "circle") {
    const double r = arguments.radius("r", "d", 1);
    const Facets facets = arguments.facets();
    if (arguments.error()) return *arguments.error();
    return make_circle(r, facets);
  }
  std::vector<glm::dvec2> points;
  for (const std::vector<double>& row : arguments.rows("points", 2)) {
    points.emplace_back(row[0], row[1]);
  }
  std::vector<std::vector<uint32_t>> paths =
      arguments.index_lists("paths", points.size(), warnings);
  if (arguments.error()) return *arguments.error();
  if (paths.empty()) return make_polygon(points, paths);
  // A path of two points encloses nothing, and the others stand.
  std::erase_if(paths, [](const std::vector<uint32_t>& path) { return path.size() < 3; });
  if (paths.empty()) return invalid_argument("polygon: encloses no area");
  return make_polygon(points, paths);
}

Result<CsgImport> csg_import(const CsgCall& call) {
  CsgArguments arguments(call);
  CsgImport import;
  FlatFileOptions& o = import.options;
  import.file = arguments.string("file", "");
  o.as_openscad = true;
  if (arguments.has("id")) o.id = arguments.string("id", "");
  // OpenSCAD 2021.01 writes `layer = ""` where no layer was asked for.
  std::string layer = arguments.string("layer", "");
  if (arguments.has("layer") && (!layer.empty() || o.id)) o.layer = std::move(layer);
  o.dpi = arguments.number("dpi", 72);
  o.scale = arguments.number("scale", 1);
  const std::vector<double> origin = arguments.numbers("origin", 2, {0, 0});
  o.origin = {origin[0], origin[1]};
  o.center = arguments.boolean("center", false);
  o.facets = arguments.facets();
  if (arguments.error()) return *arguments.error();
  return import;
}

Result<CsgText> csg_text(const CsgCall& call, std::vector<std::string>& warnings) {
  if (auto failure = text_failure()) return *std::move(failure);
  CsgArguments arguments(call);
  CsgText text;
  TextOptions& o = text.options;
  o.text = arguments.string("text", "");
  o.size = arguments.number("size", 10);
  o.spacing = arguments.number("spacing", 1);
  o.direction = arguments.string("direction", "");
  o.language = arguments.string("language", "en");
  o.script = arguments.string("script", "");
  o.halign = arguments.string("halign", "default");
  o.valign = arguments.string("valign", "default");
  o.facets = arguments.facets();
  o.as_openscad_rounds = true;
  if (o.size < 0) {
    // OpenSCAD turns such a text by half a turn, and its curves have the fewest steps.
    text.upside_down = true;
    o.size = -o.size;
    o.facets = Facets{3};
  }
  text.font = arguments.string("font", "");
  if (arguments.error()) return *arguments.error();
  const auto keep_known = [&](const char* name, std::string& value, const std::string& otherwise,
                              std::initializer_list<std::string_view> known) {
    if (std::find(known.begin(), known.end(), value) != known.end()) return;
    warnings.push_back("text: there is no " + std::string(name) + " " + quoted(value) +
                       ", the default was taken");
    value = otherwise;
  };
  keep_known("direction", o.direction, "", {"", "ltr", "rtl", "ttb", "btt"});
  keep_known("halign", o.halign, "default", {"default", "left", "center", "right"});
  keep_known("valign", o.valign, "default", {"default", "baseline", "bottom", "center", "top"});
  FontFeatures font = split_font_features(text.font);
  if (!font.note.empty()) warnings.push_back("text: " + font.note);
  text.font = std::move(font.font);
  o.features = std::move(font.features);
  return text;
}

Result<OffsetOptions> csg_offset(const CsgCall& call) {
  CsgArguments arguments(call);
  OffsetOptions options;
  const bool sharp = arguments.has("delta") && !arguments.has("r");
  options.distance = arguments.number(sharp ? "delta" : "r", 1);
  const bool chamfer = arguments.boolean("chamfer", false);
  if (sharp) options.join = chamfer ? OffsetJoin::kChamfer : OffsetJoin::kMitre;
  options.facets = arguments.facets();
  if (arguments.error()) return *arguments.error();
  return options;
}

Result<CsgResize> csg_resize(const CsgCall& call) {
  CsgArguments arguments(call);
  const std::vector<double> newsize = arguments.numbers("newsize", 3, {0, 0, 0});
  const std::vector<double> automatic = arguments.numbers("auto", 3, {0, 0, 0});
  if (arguments.error()) return *arguments.error();
  CsgResize resize;
  for (size_t i = 0; i < 3; ++i) {
    if (!std::isfinite(newsize[i])) return not_finite("resize", "newsize", newsize[i]);
    resize.newsize[i] = std::max(newsize[i], 0.0);
    resize.automatic[i] = automatic[i] != 0;
  }
  return resize;
}

Result<RoofOptions> csg_roof(const CsgCall& call, std::vector<std::string>& warnings) {
  CsgArguments arguments(call);
  RoofOptions options;
  const std::string method = arguments.string("method", "voronoi");
  options.facets = arguments.facets();
  options.divide_between_corners = false;
  if (arguments.error()) return *arguments.error();
  if (method == "straight") {
    options.method = RoofMethod::kStraight;
  } else if (method != "voronoi") {
    warnings.push_back("roof: there is no method " + quoted(method) + ", \"voronoi\" was taken");
  }
  return options;
}

namespace {

MeshResult linear_extrude_csg(CsgArguments& arguments, const CsgCall& call, const Shape2D& shape) {
  LinearExtrudeOptions options;
  options.height = arguments.number("height", 100);
  options.height_given = arguments.has("height") || !arguments.has("v");
  if (arguments.has("v")) {
    const std::vector<double> v = arguments.numbers("v", 3, {0, 0, 1});
    options.direction = glm::dvec3(v[0], v[1], v[2]);
  }
  options.center = arguments.boolean("center", false);
  options.twist = arguments.number("twist", 0);
  const CsgValue* scale = call.find("scale");
  if (scale != nullptr && scale->kind == Kind::kNumber) {
    options.scale = glm::dvec2(scale->number);
  } else if (scale != nullptr) {
    const std::vector<double> both = arguments.numbers("scale", 2, {1, 1});
    options.scale = {both[0], both[1]};
  }
  // OpenSCAD takes a negative scale of the top as 0.
  if (options.scale.x < 0) options.scale.x = 0;
  if (options.scale.y < 0) options.scale.y = 0;
  // NaN compares with nothing, and is no number of anything.
  for (const char* name : {"slices", "segments"}) {
    const double value = arguments.number(name, 0);
    if (std::isnan(value)) return not_finite("linear_extrude", name, value);
  }
  auto whole = [&](const char* name, double least) {
    return static_cast<int>(std::clamp(arguments.number(name, 0), least, 1e9));
  };
  if (arguments.has("slices")) options.slices = whole("slices", 1);
  if (arguments.has("segments")) options.segments = whole("segments", 0);
  options.facets = arguments.facets();
  if (arguments.error()) return *arguments.error();
  return linear_extrude(shape, options);
}

}  // namespace

Result<NodePtr> extrude_csg(const CsgCall& call, const Shape2D& shape, const SourceRef& where) {
  CsgArguments arguments(call);
  if (call.name == "rotate_extrude") {
    RotateExtrudeOptions options;
    options.angle = arguments.number("angle", 360);
    const bool full = options.angle <= -360 || options.angle >= 360;
    // Files of OpenSCAD 2021 have no start: a full turn begins on the negative side.
    options.start = arguments.number("start", full ? 180 : 0);
    options.facets = arguments.facets();
    if (arguments.error()) return *arguments.error();
    return rotate_extrude_solid(shape, options, where);
  }
  auto mesh = linear_extrude_csg(arguments, call, shape);
  if (!mesh) return mesh.error();
  return Node::leaf(std::make_shared<const PolygonMesh>(*std::move(mesh)), where);
}

Result<std::optional<Appearance>> csg_color(const CsgCall& call) {
  const CsgValue* value = call.find("c");
  if (value == nullptr || !is_number_list(*value, 4)) {
    return Error{ErrorCode::kMalformedFile, "color: expected a list of 4 numbers", {}};
  }
  const std::vector<double> rgba = number_list(*value);
  if (rgba[0] < 0) return std::optional<Appearance>();  // color() without a colour: -1 in all four
  const auto component = [](double v) {
    return static_cast<float>(v > 0 ? std::min(v, 1.0) : 0.0);
  };
  return std::optional(appearance_of({component(rgba[0]), component(rgba[1]), component(rgba[2]),
                                      rgba[3] < 0 ? 1.0f : component(rgba[3])}));
}

}  // namespace csgrun
