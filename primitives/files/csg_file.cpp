// Builds the tree from the bottom up: each call is built when its block closes, from what its
// children came to. The open calls stand on a stack of our own.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <csgrun/primitives/csg_file.h>
#include <csgrun/primitives/height_map.h>
#include <csgrun/primitives/mesh_file.h>
#include <csgrun/primitives/projection.h>
#include <csgrun/primitives/shape_operations.h>

#include "primitives/files/csg_import.h"
#include "primitives/files/csg_items.h"
#include "primitives/files/csg_parser.h"
#include "primitives/files/csg_shapes.h"
#include "primitives/files/csg_sheets.h"
#include "primitives/files/csg_signatures.h"
#include "primitives/files/formats.h"
#include "primitives/files/read_file.h"

namespace csgrun {
namespace {

class CsgBuilder {
 public:
  CsgBuilder(const std::string& name, std::string_view text, const CsgEnvironment& environment)
      : file_(environment.file ? environment.file : std::make_shared<const std::string>(name)),
        parser_(file_, text),
        environment_(environment) {}

  Result<CsgModel> build() {
    stack_.emplace_back();  // the file itself: a union
    stack_.back().call.name = "union";
    stack_.back().call.line = 1;
    for (;;) {
      const Result<CsgParser::Event> event = parser_.next();
      if (!event) return event.error();
      if (*event == CsgParser::Event::kEnd) break;
      if (*event == CsgParser::Event::kClose) {
        if (stack_.size() == 1) return parser_.error("\"}\" without \"{\"");
        if (auto status = close(); !status) return status.error();
        continue;
      }
      const bool background = stack_.back().background || parser_.call().background;
      const OfSheets asked = stack_.back().asks;
      CsgFrame& frame = stack_.emplace_back();
      frame.call = std::move(parser_.call());
      frame.background = background;
      frame.asked = asked;
      if (!background) {
        std::vector<std::string> notes;
        frame.import = take_import(frame.call);
        name_arguments(frame.call, notes);
        clamp_facets(frame.call, notes);
        for (const std::string& note : notes) warn(frame, note);
        add_facets(frame.call, environment_.facets);
      }
      frame.asks = asked_of_children(frame.call, asked);
      if (*event == CsgParser::Event::kOpen) continue;
      if (auto status = close(); !status) return status.error();
    }
    if (stack_.size() > 1) {
      return parser_.error("the file ends within " + stack_.back().call.name + "() of line " +
                           std::to_string(stack_.back().call.line));
    }
    if (root_) stack_.back().children.assign(1, *std::move(root_));
    Result<Item> all = combine(BooleanOp::kUnion, stack_.back());
    if (!all) return all.error();
    settle_cuts(*all);
    CsgModel model;
    model.is_2d = all->kind == Item::Kind::kFlat && !all->is_empty();
    model.shape = all->shape;
    model.appearance = all->appearance;
    model.solid = all->kind == Item::Kind::kSolid ? all->solid : Node::empty(SourceRef{file_, 1});
    model.warnings = std::move(warnings_);
    return model;
  }

 private:
  [[nodiscard]] SourceRef where(const CsgFrame& frame) const {
    return SourceRef{file_, frame.call.line};
  }

  void warn(const CsgFrame& frame, const std::string& what) {
    warnings_.push_back(where(frame).text() + ": " + what);
  }

  /// Builds the innermost open call and hands it to the one around it.
  Status close() {
    CsgFrame frame = std::move(stack_.back());
    stack_.pop_back();
    if (frame.background) return std::monostate();
    Result<Item> item = build(frame);
    if (!item) {
      Error error = item.error();
      error.where = where(frame);
      return error;
    }
    if (frame.call.root && !root_) root_ = *item;
    stack_.back().children.push_back(*std::move(item));
    return std::monostate();
  }

  Result<Item> build(CsgFrame& frame) {
    const std::string& name = frame.call.name;
    if (!frame.children.empty() && !takes_children(name)) {
      warn(frame, name + ": takes no children, they were left out");
    }
    if (name == "union" || name == "group" || name == "render") {
      return combine(BooleanOp::kUnion, frame);
    }
    if (name == "difference") return combine(BooleanOp::kDifference, frame);
    if (name == "intersection") return combine(BooleanOp::kIntersection, frame);
    if (name == "multmatrix") return transform(frame);
    if (name == "color") return paint(frame);
    if (name == "linear_extrude" || name == "rotate_extrude") return extrude(frame);
    if (is_solid_primitive(name)) {
      std::vector<std::string> notes;
      PolygonMesh uncut, open;
      MeshResult mesh =
          make_csg_solid(frame.call, notes, uncut, takes_open_ones(frame.asked) ? &open : nullptr);
      if (mesh || open.corners.empty()) {
        Result<Item> item = leaf(frame, std::move(mesh), notes);
        if (item) item->uncut = uncut_of(std::move(uncut));
        return item;
      }
      for (const std::string& note : notes) warn(frame, note);
      return open_item(frame, open);
    }
    if (is_flat_primitive(name)) return flat_primitive(frame);
    if (name == "text") return text(frame);
    if (name == "import") return import(frame);
    if (name == "surface") return surface(frame);
    if (name == "offset") return offset(frame);
    if (name == "hull") return hull(frame);
    if (name == "minkowski") return minkowski(frame);
    if (name == "fill") return fill(frame);
    if (name == "resize") return resize(frame);
    if (name == "projection") return projection(frame);
    if (name == "roof") return roof(frame);
    return Error{ErrorCode::kMalformedFile,
                 "unknown node " + name + "()" + std::string(source_hint(name)),
                 {}};
  }

  /// A leaf of the mesh; impossible arguments make it empty.
  Result<Item> leaf(const CsgFrame& frame, MeshResult mesh, const std::vector<std::string>& notes) {
    for (const std::string& note : notes) warn(frame, note);
    if (mesh) {
      return Item::of(
          Node::leaf(std::make_shared<const PolygonMesh>(*std::move(mesh)), where(frame)));
    }
    return empty_if_impossible(frame, mesh.error(), Item::Kind::kSolid);
  }

  /// Impossible numbers make something empty, as in OpenSCAD; any other error is one.
  Result<Item> empty_if_impossible(const CsgFrame& frame, const Error& error, Item::Kind kind) {
    if (error.code != ErrorCode::kInvalidArgument) return error;
    warn(frame, error.message);
    return Item::empty(kind);
  }

  /// A mesh that is not closed, where that does not matter.
  [[nodiscard]] Item open_item(const CsgFrame& frame, const PolygonMesh& mesh) const {
    if (frame.asked == OfSheets::kCorners) return Item::of(leaf_of_corners(mesh, where(frame)));
    return Item::with_sheet(Node::empty(), sheet_of(mesh), {});
  }

  Result<Item> flat_primitive(const CsgFrame& frame) {
    std::vector<std::string> notes;
    Result<Shape2D> shape = make_csg_shape(frame.call, notes);
    return flat_leaf(frame, std::move(shape), notes);
  }

  /// A shape; impossible arguments make it empty.
  Result<Item> flat_leaf(const CsgFrame& frame, Result<Shape2D> shape,
                         const std::vector<std::string>& notes,
                         const std::optional<Appearance>& appearance = {}) {
    for (const std::string& note : notes) warn(frame, note);
    if (shape) return Item::of(*std::move(shape), appearance);
    return empty_if_impossible(frame, shape.error(), Item::Kind::kFlat);
  }

  Result<Item> surface(const CsgFrame& frame) {
    CsgArguments arguments(frame.call);
    const std::string path = arguments.string("file", "");
    const bool center = arguments.boolean("center", false);
    const bool invert = arguments.boolean("invert", false);
    if (arguments.error()) return *arguments.error();
    if (path.empty()) return without_file(frame);
    if (!environment_.read) {
      return Error{ErrorCode::kInvalidArgument, "surface: there are no files here", {}};
    }
    const Result<std::string> bytes = environment_.read(path);
    if (!bytes) return Error{bytes.error().code, "surface: " + bytes.error().message, {}};
    const Result<HeightMap> map = parse_height_map(path, *bytes, invert);
    if (!map) return Error{map.error().code, "surface: " + map.error().message, {}};
    return leaf(frame, make_surface(*map, center), {});
  }

  /// What a call without a name, or with one that is no string, is written as.
  Result<Item> without_file(const CsgFrame& frame) {
    warn(frame, frame.call.name + ": names no file, it is empty");
    return Item::empty(Item::Kind::kSolid);
  }

  /// A mesh, or a drawing. A file that is not there is an error: nothing is dropped silently.
  Result<Item> import(const CsgFrame& frame) {
    const Result<CsgImport> import = csg_import(frame.call);
    if (!import) return import.error();
    const std::string& path = import->file;
    if (path.empty()) return without_file(frame);
    const bool drawing = !flat_file_format_of(path).empty();
    const bool archive = is_3mf_path(path) || is_amf_path(path);
    if (!drawing && !archive && mesh_format_of(path).empty()) {
      return Error{ErrorCode::kInvalidArgument,
                   "import: " + quoted(path) +
                       " has none of the endings .stl, .off, .obj, .ply, .3mf, .amf, .svg, .dxf",
                   {}};
    }
    if (!environment_.read) {
      return Error{ErrorCode::kInvalidArgument, "import: there are no files here", {}};
    }
    const Result<std::string> bytes = environment_.read(path);
    if (!bytes) return Error{bytes.error().code, "import: " + bytes.error().message, {}};
    if (drawing) {
      Result<FlatFile> file = parse_flat(path, *bytes, import->options);
      if (!file) return Error{file.error().code, "import: " + file.error().message, {}};
      for (const std::string& note : file->notes) warn(frame, "import: " + note);
      return Item::of(std::move(file->shape));
    }
    std::vector<std::string> notes;
    auto parts = csg_import_parts(path, *bytes, import->options.center, notes);
    if (!parts) return Error{parts.error().code, "import: " + parts.error().message, {}};
    std::vector<NodePtr> solids;
    CsgSheet sheet;
    PolygonMesh uncut;
    for (ModelPart& part : *parts) {
      std::string note;
      part.mesh.kind = path;
      Result<PolygonMesh> mesh = make_solid_mesh(part.mesh, &note, &uncut);
      if (!mesh && takes_open_ones(frame.asked) && is_sheet(part.mesh)) {
        Item item = open_item(frame, part.mesh);
        sheet.append(std::move(item.sheet));
        solids.push_back(std::move(item.solid));
        continue;
      }
      if (!mesh) mesh = repaired_or(std::move(mesh), std::move(part.mesh), notes, &uncut);
      if (!mesh) return Error{mesh.error().code, "import: " + mesh.error().message, {}};
      if (!note.empty()) notes.push_back(note);
      solids.push_back(
          Node::leaf(std::make_shared<const PolygonMesh>(*std::move(mesh)), where(frame)));
    }
    for (const std::string& note : notes) warn(frame, "import: " + note);
    // Formats of several parts have triangles only.
    UncutPtr whole = solids.size() == 1 ? uncut_of(std::move(uncut)) : nullptr;
    NodePtr all = solids.size() == 1
                      ? solids[0]
                      : Node::boolean(BooleanOp::kUnion, std::move(solids), where(frame));
    return Item::with_sheet(std::move(all), std::move(sheet), {}, std::move(whole));
  }

  Result<Item> text(const CsgFrame& frame) {
    std::vector<std::string> notes;
    const Result<CsgText> text = csg_text(frame.call, notes);
    if (!text) return text.error();
    FontBook shipped;
    FontBook& fonts = environment_.fonts != nullptr ? *environment_.fonts : shipped;
    const Result<FontChoice> choice = fonts.find(text->font);
    if (!choice) return Error{choice.error().code, "text: " + choice.error().message, {}};
    if (!choice->note.empty()) notes.push_back("text: " + choice->note);
    std::string note;
    Result<Shape2D> shape = make_text(text->options, choice->font, &note);
    if (!note.empty()) notes.push_back(note);
    if (shape && text->upside_down) {
      Affine half_turn;
      half_turn.m[0][0] = half_turn.m[1][1] = -1;
      shape = shape->transformed(half_turn);
    }
    return flat_leaf(frame, std::move(shape), notes);
  }

  /// What settle_kind says, with its notes as warnings.
  Item::Kind settle(CsgFrame& frame) {
    std::vector<std::string> notes;
    const Item::Kind kind = settle_kind(frame.children, notes);
    for (const std::string& note : notes) warn(frame, note);
    return kind;
  }

  std::optional<Appearance> colour_of_shapes(const CsgFrame& frame) {
    std::vector<std::string> notes;
    const auto colour = colour_of_first(frame.call.name, frame.children, notes);
    for (const std::string& note : notes) warn(frame, note);
    return colour;
  }

  /// Makes nothing of the children of one kind.
  void leave_out(CsgFrame& frame, Item::Kind kind, const std::string& what) {
    for (Item& child : frame.children) {
      if (child.kind != kind) continue;
      if (!child.is_empty()) warn(frame, frame.call.name + ": " + what + " was left out");
      child = Item();
    }
  }

  static Result<Item> item_of(Result<Shape2D> shape,
                              const std::optional<Appearance>& appearance = {}) {
    if (!shape) return shape.error();
    return Item::of(*std::move(shape), appearance);
  }

  /// The children under a Boolean.
  Result<Item> combine(BooleanOp op, CsgFrame& frame) {
    const Item::Kind kind = settle(frame);
    if (kind == Item::Kind::kNothing) return Item();
    if (kind == Item::Kind::kFlat) {
      if (is_one_empty(frame.children)) return Item();
      const auto colour = colour_of_shapes(frame);
      return item_of(Shape2D::boolean(op, take_shapes(frame.children)), colour);
    }
    std::optional<Appearance> colour;
    UncutPtr uncut = hand_on_or_settle(op, frame.children);
    CsgSheet sheet = take_sheets(frame.children, colour);
    return Item::with_sheet(combine_solids(op, frame.children, where(frame)), std::move(sheet),
                            colour, std::move(uncut));
  }

  /// The union of the 2D children; solids are left out, with a warning.
  Result<Item> combine_flat(CsgFrame& frame) {
    leave_out(frame, Item::Kind::kSolid, "a 3D child");
    return combine(BooleanOp::kUnion, frame);
  }

  Result<Item> offset(CsgFrame& frame) {
    const Result<OffsetOptions> options = csg_offset(frame.call);
    if (!options) return options.error();
    Result<Item> child = combine_flat(frame);
    if (!child || child->is_empty()) return child;
    return flat_leaf(frame, offset_shape(child->shape, *options), {}, child->appearance);
  }

  Result<Item> hull(CsgFrame& frame) {
    const Item::Kind kind = settle(frame);
    if (kind == Item::Kind::kNothing) return Item();
    if (kind == Item::Kind::kFlat) {
      const auto colour = colour_of_shapes(frame);
      return item_of(hull_of_shapes(take_shapes(frame.children)), colour);
    }
    std::vector<NodePtr> solids = take_solids(frame.children);
    if (solids.empty()) return Item();
    return Item::of(Node::convex_hull(std::move(solids), where(frame)));
  }

  Result<Item> minkowski(CsgFrame& frame) {
    const Item::Kind kind = settle(frame);
    if (kind == Item::Kind::kNothing) return Item();
    if (kind == Item::Kind::kFlat) {
      if (is_one_empty(frame.children)) return Item();
      const auto colour = colour_of_shapes(frame);
      if (sum_of_shapes_is_empty(frame.children)) {
        warn(frame, "minkowski: the sum of a shape and an empty one is empty");
        return Item::empty(kind);
      }
      return item_of(minkowski_of_shapes(take_shapes(frame.children)), colour);
    }
    if (is_one_empty(frame.children)) return std::move(frame.children[0]);
    UncutPtr uncut = hand_on_or_settle(BooleanOp::kUnion, frame.children);
    std::vector<NodePtr> solids = take_solids(frame.children);
    if (solids.empty()) return Item();
    if (solids.size() == 1) return Item::with_sheet(std::move(solids[0]), {}, {}, std::move(uncut));
    return Item::of(Node::minkowski_sum(std::move(solids), where(frame)));
  }

  Result<Item> fill(CsgFrame& frame) {
    Result<Item> child = combine(BooleanOp::kUnion, frame);
    if (!child || child->is_empty()) return child;
    if (child->kind == Item::Kind::kFlat)
      return item_of(fill_shape(child->shape), child->appearance);
    warn(frame, "fill: has no meaning for 3D children, they were united");
    return child;
  }

  Result<Item> resize(CsgFrame& frame) {
    const Result<CsgResize> wanted = csg_resize(frame.call);
    Result<Item> child = combine(BooleanOp::kUnion, frame);
    if (!wanted && child) return empty_if_impossible(frame, wanted.error(), child->kind);
    if (!child || child->is_empty()) return child;
    if (child->kind == Item::Kind::kSolid) {
      const Resize resize{wanted->newsize, wanted->automatic};
      UncutPtr uncut = resized(child->uncut, resize);
      return Item::with_sheet(Node::resized(resize, std::move(child->solid), where(frame)), {}, {},
                              std::move(uncut));
    }
    const auto [low, high] = child->shape.bounds();
    const auto factors = resize_factors<2>({high.x - low.x, high.y - low.y},
                                           {wanted->newsize[0], wanted->newsize[1]},
                                           {wanted->automatic[0], wanted->automatic[1]});
    Affine map;
    map.m[0][0] = factors[0];
    map.m[1][1] = factors[1];
    return flat_leaf(frame, child->shape.transformed(map), {}, child->appearance);
  }

  Result<Item> projection(CsgFrame& frame) {
    CsgArguments arguments(frame.call);
    const bool cut = arguments.boolean("cut", false);
    if (arguments.error()) return *arguments.error();
    leave_out(frame, Item::Kind::kFlat, "a 2D child");
    Result<Item> child = combine(BooleanOp::kUnion, frame);
    if (!child) return child;
    if (child->is_empty()) return Item();
    settle_cuts(*child);
    Result<Shape2D> shape = cut ? slice_solid(evaluator(), child->solid, 0) : shadow(*child);
    if (!shape) return failed(shape.error());
    if (shape->empty()) return Item();
    const bool is_sheet_only = child->solid->kind() == NodeKind::kEmpty;
    return Item::of(*std::move(shape),
                    is_sheet_only ? child->appearance : one_appearance_of(child->solid));
  }

  /// Of a solid and of the sheet beside it.
  Result<Shape2D> shadow(const Item& item) {
    const auto solid = evaluator().evaluate(item.solid, Measuring::kNothing);
    if (!solid) return solid.error();
    Result<Shape2D> shape = project_solid(**solid, evaluator().stats().grid_mm);
    if (!shape || item.sheet.empty()) return shape;
    const Result<Shape2D> more = shadow_of(item.sheet);
    if (!more) return more.error();
    return Shape2D::boolean(BooleanOp::kUnion, {*shape, *more});
  }

  /// An error of an evaluation.
  [[nodiscard]] Error failed(const Error& error) const {
    if (environment_.evaluation_failed != nullptr) *environment_.evaluation_failed = true;
    return error;
  }

  Evaluator& evaluator() {
    if (environment_.evaluator != nullptr) return *environment_.evaluator;
    if (!own_evaluator_) own_evaluator_ = std::make_unique<Evaluator>(EvaluateOptions{});
    return *own_evaluator_;
  }

  Result<Item> transform(CsgFrame& frame) {
    CsgArguments arguments(frame.call);
    const std::optional<Affine> map = arguments.matrix();
    if (arguments.error()) return *arguments.error();
    Result<Item> child = combine(BooleanOp::kUnion, frame);
    if (!child || child->is_empty()) return child;
    for (const auto& row : map->m) {
      if (std::all_of(row.begin(), row.end(), [](double v) { return std::isfinite(v); })) continue;
      warn(frame, "multmatrix: the matrix is not finite, its children were left out");
      return Item::empty(child->kind);
    }
    if (child->kind == Item::Kind::kFlat) {
      Result<Shape2D> shape = child->shape.transformed(*map);
      if (shape && shape->empty()) warn_flattened(frame);
      return flat_leaf(frame, std::move(shape), {}, child->appearance);
    }
    const auto& m = map->m;
    const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    if (determinant == 0) return flattened(frame, *map, *std::move(child));
    NodePtr solid = child->solid->kind() == NodeKind::kEmpty
                        ? child->solid
                        : Node::transformed(*map, child->solid, where(frame));
    return Item::with_sheet(std::move(solid), mapped(std::move(child->sheet), *map),
                            child->appearance, moved(child->uncut, *map, determinant < 0));
  }

  /// What a matrix makes flat is empty, but in a hull, a sum, or a shadow.
  Result<Item> flattened(const CsgFrame& frame, const Affine& map, Item child) {
    if (frame.asked == OfSheets::kNothing) {
      warn_flattened(frame);
      return Item::empty(Item::Kind::kSolid);
    }
    settle_cuts(child);
    if (frame.asked != OfSheets::kFaces) {
      const bool is_for_hull = frame.asked == OfSheets::kCorners;
      Result<NodePtr> flat = is_for_hull
                                 ? flattened_corners(child.solid, map, evaluator(), where(frame))
                                 : flattened_parts(child.solid, map, evaluator(), where(frame));
      if (!flat) return failed(flat.error());
      return Item::of(*std::move(flat));
    }
    const auto solid = evaluator().evaluate(child.solid, Measuring::kNothing);
    if (!solid) return failed(solid.error());
    CsgSheet sheet = mapped(std::move(child.sheet), map);
    sheet.append(sheet_of(**solid, map));
    const auto colour =
        child.solid->kind() == NodeKind::kEmpty ? child.appearance : one_appearance_of(child.solid);
    return Item::with_sheet(Node::empty(), std::move(sheet), colour);
  }

  void warn_flattened(const CsgFrame& frame) {
    warn(frame, "multmatrix: the matrix flattens its children, they were left out");
  }

  Result<Item> paint(CsgFrame& frame) {
    const auto color = csg_color(frame.call);
    if (!color) return color.error();
    Result<Item> child = combine(BooleanOp::kUnion, frame);
    if (!child || child->is_empty() || !*color) return child;
    const Appearance& appearance = **color;
    if (child->kind == Item::Kind::kFlat) {
      child->appearance = appearance;
      return child;
    }
    NodePtr painted = child->solid->kind() == NodeKind::kEmpty
                          ? child->solid
                          : Node::painted(appearance, child->solid, where(frame));
    return Item::with_sheet(std::move(painted), std::move(child->sheet), appearance,
                            std::move(child->uncut));
  }

  Result<Item> extrude(CsgFrame& frame) {
    if (frame.import) {
      CsgFrame drawing;
      drawing.call = *std::move(frame.import);
      Result<Item> item = import(drawing);
      if (!item) return item;
      frame.children.assign(1, *std::move(item));
    }
    Result<Item> profile = combine_flat(frame);
    if (!profile || profile->kind == Item::Kind::kNothing) return profile;
    if (profile->is_empty()) return Item::empty(Item::Kind::kSolid);
    const Result<NodePtr> node = extrude_csg(frame.call, profile->shape, where(frame));
    Result<Item> solid = node ? Result<Item>(Item::of(*node))
                              : empty_if_impossible(frame, node.error(), Item::Kind::kSolid);
    // One that cannot be turned has no dimension in OpenSCAD, one of no height has.
    if (solid && solid->is_empty() && frame.call.name == "rotate_extrude") return Item();
    return painted(frame, std::move(solid), *profile);
  }

  Result<Item> roof(CsgFrame& frame) {
    std::vector<std::string> notes;
    const Result<RoofOptions> options = csg_roof(frame.call, notes);
    if (!options) return options.error();
    Result<Item> profile = combine_flat(frame);
    if (!profile || profile->kind == Item::Kind::kNothing) return profile;
    if (profile->is_empty()) return Item::empty(Item::Kind::kSolid);
    return painted(frame, leaf(frame, make_roof(profile->shape, *options), notes), *profile);
  }

  /// A solid that was made of a shape has its colour.
  Result<Item> painted(const CsgFrame& frame, Result<Item> solid, const Item& shape) {
    if (solid && !solid->is_empty() && shape.appearance)
      solid->solid = Node::painted(*shape.appearance, std::move(solid->solid), where(frame));
    return solid;
  }

  std::shared_ptr<const std::string> file_;
  CsgParser parser_;
  const CsgEnvironment& environment_;
  std::unique_ptr<Evaluator> own_evaluator_;
  std::vector<CsgFrame> stack_;
  std::optional<Item> root_;  ///< what is marked with !, the first of it
  std::vector<std::string> warnings_;
};

}  // namespace

Result<CsgModel> parse_csg(const std::string& name, std::string_view text,
                           const CsgEnvironment& environment) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // as editors of Windows write it
  return CsgBuilder(name, text, environment).build();
}

Result<CsgModel> read_csg_file(const std::string& path, const CsgEnvironment& environment) {
  const Result<std::string> bytes = read_regular_file(path);
  if (!bytes) return bytes.error();
  return parse_csg(path, *bytes, environment);
}

}  // namespace csgrun
