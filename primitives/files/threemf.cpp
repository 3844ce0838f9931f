// 3MF: an archive with an XML document of objects, and of what is built of them.
//
// 3MF Core Specification 1.3; of the Materials and Properties Extension 1.2 colour groups and
// metallic display properties; of the Production Extension 1.1 objects in other documents of the
// archive, as slicers write them. Textures and slices are passed over; beams and shapes that are no
// meshes too, with a note.
#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include <pugixml.hpp>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/primitives/file_ending.h>
#include <csgrun/primitives/model_file.h>

#include "primitives/files/formats.h"
#include "primitives/files/threemf_model.h"
#include "primitives/files/threemf_xml.h"
#include "primitives/files/unzip.h"

namespace csgrun {
namespace {

constexpr int kDeepest = 32;  // components in components beyond this contain themselves
constexpr size_t kMostDocuments = 10'000;  // each takes memory, however small it is
/// Of points and triangles.
constexpr uint64_t kManyElements = 5'000'000, kMostCopies = 100;

/// The map of an object that is measured in another unit than what it stands in.
Affine scaled_first(Affine map, double factor) {
  for (auto& row : map.m) {
    for (size_t column = 0; column < 3; ++column) row[column] *= factor;
  }
  return map;
}

/// A document of the archive and what it says.
struct Part {
  std::string path, text;
  pugi::xml_document xml;
  std::unique_ptr<ModelDocument> model;
};

class PackageReader {
 public:
  PackageReader(const std::string& name, ZipArchive archive, std::vector<std::string>* notes,
                FileUnit unit)
      : name_(name), archive_(std::move(archive)), notes_(notes), unit_(unit) {}

  Result<std::vector<ModelPart>> read() {
    try {
      Part& root = part(root_path());
      const pugi::xml_node build = find_child(root.xml.document_element(), "build");
      if (!build) throw ModelFault{"the model has no build"};
      count_all(root, build);
      std::vector<ModelPart> parts;
      for (const pugi::xml_node& node : build.children()) {
        if (local_name(node.name()) != "item") continue;
        ModelPart item = built(root, reference_of(node));
        if (item.mesh.face_count() > 0) parts.push_back(std::move(item));
      }
      if (parts.empty()) {
        throw ModelFault{"has no faces" + (notes_->empty() ? "" : ": " + notes_->front())};
      }
      return parts;
    } catch (const ModelFault& fault) {
      Error error = malformed(name_, place_, fault.what);
      error.code = fault.code;
      return error;
    } catch (const Error& error) {
      return error;
    }
  }

 private:
  /// The bytes of an entry of the archive. Throws Error.
  std::string bytes_of(const std::string& path) {
    auto bytes = archive_.entry(path);
    if (!bytes) throw bytes.error();
    if (!*bytes) throw malformed(name_, "", "it has no " + quoted(path));
    return **std::move(bytes);
  }

  /// The path of the model that everything begins with.
  std::string root_path() {
    auto relations = archive_.entry("_rels/.rels");
    if (!relations) throw relations.error();
    if (!*relations) throw malformed(name_, "", "it is no 3MF file: it has no _rels/.rels");
    place_ = "_rels/.rels";
    pugi::xml_document document;
    if (!document.load_buffer((*relations)->data(), (*relations)->size()))
      throw ModelFault{"is malformed XML"};
    for (const pugi::xml_node& node : document.document_element().children()) {
      const std::string type = find_attribute(node, "Type").value();
      const std::string target = find_attribute(node, "Target").value();
      if (type.ends_with("/3dmodel") && !target.empty()) return target;
    }
    throw ModelFault{"names no model"};
  }

  /// The document at a path, which is read when it is first asked for.
  Part& part(const std::string& path) {
    const std::string entry = path.starts_with('/') ? path.substr(1) : path;
    std::unique_ptr<Part>& known = parts_[entry];
    if (known) return *known;
    if (parts_.size() > kMostDocuments) {
      throw ModelFault{"it has more than " + std::to_string(kMostDocuments) + " documents",
                       ErrorCode::kLimit};
    }
    auto fresh = std::make_unique<Part>();
    fresh->path = entry;
    fresh->text = bytes_of(entry);
    place_ = entry;
    const pugi::xml_parse_result parsed =
        fresh->xml.load_buffer_inplace(fresh->text.data(), fresh->text.size());
    if (!parsed) {
      throw ModelFault{"malformed XML at byte " + std::to_string(parsed.offset) + ": " +
                       parsed.description()};
    }
    const pugi::xml_node model = fresh->xml.document_element();
    if (local_name(model.name()) != "model") throw ModelFault{"it is no 3MF model"};
    fresh->model = std::make_unique<ModelDocument>(model);
    known = std::move(fresh);
    return *known;
  }

  /// The document that a reference of `from` leads to.
  Part& part_of(Part& from, const ModelReference& reference) {
    return reference.path.empty() ? from : part(reference.path);
  }

  /// Components multiply: how many points and triangles they come to is counted before any is
  /// made. Also adds up those of the objects that are reached, once each.
  ModelObject& count(Part& owner, uint32_t id, int depth) {
    place_ = owner.path;
    ModelObject& each = owner.model->object(id);
    if (each.expanded == 0 && depth <= kDeepest) {
      ModelDocument::note_what_is_left_out(each, notes_);
      uint64_t sum = each.elements + 1;
      if (each.left_out.empty()) {
        for (const ModelReference& component : each.components) {
          const ModelObject& inner = count(part_of(owner, component), component.object, depth + 1);
          sum = std::min<uint64_t>(sum + inner.expanded, uint64_t{1} << 40);
          each.height = std::max(each.height, inner.height + 1);
        }
      }
      each.expanded = sum;
      own_ += each.elements + 1;
    }
    if (depth + each.height > kDeepest)
      throw ModelFault{"components nest too deep (does an object contain itself?)"};
    return each;
  }

  void count_all(Part& root, const pugi::xml_node& build) {
    uint64_t all = 0;
    for (const pugi::xml_node& node : build.children()) {
      if (local_name(node.name()) != "item") continue;
      const ModelReference item = reference_of(node);
      all += count(part_of(root, item), item.object, 0).expanded;
    }
    if (all > kManyElements && all / kMostCopies > own_)
      throw ModelFault{"its components multiply to more than a model would", ErrorCode::kLimit};
  }

  /// How many millimetres a unit of a document is.
  [[nodiscard]] double unit_of(const Part& part) const {
    return unit_ == FileUnit::kNamed ? part.model->unit() : 1;
  }

  ModelPart built(Part& root, const ModelReference& item) {
    Part& owner = part_of(root, item);
    ModelPart result;
    result.name = owner.model->object(item.object).name;
    Affine map = item.map;
    for (auto& row : map.m) {
      for (double& entry : row) entry *= unit_of(root);
    }
    numbers_.clear();
    add(root, item, map, result.mesh);
    // What has no colour anywhere has no appearances either.
    if (result.mesh.appearances.size() == 1 && result.mesh.appearances[0].is_default) {
      result.mesh.appearances.clear();
      result.mesh.appearance_of.clear();
    }
    limit_appearances(result.mesh, notes_);
    return result;
  }

  /// What a reference of `from` leads to, appended. The map is from the units of `from`.
  void add(Part& from, const ModelReference& reference, const Affine& map, PolygonMesh& mesh) {
    Part& owner = part_of(from, reference);
    place_ = owner.path;
    const double factor = unit_of(owner) / unit_of(from);
    const Affine placed = factor == 1 ? map : scaled_first(map, factor);
    const ModelObject& each = owner.model->object(reference.object);
    if (!each.left_out.empty()) return;
    if (each.mesh) owner.model->add_mesh(each, placed, mesh, numbers_);
    for (const ModelReference& component : each.components)
      add(owner, component, Affine::compose(placed, component.map), mesh);
  }

  const std::string& name_;
  ZipArchive archive_;
  std::vector<std::string>* notes_;  ///< never null
  FileUnit unit_;
  std::string place_;  ///< which document is being read, for messages
  std::map<std::string, std::unique_ptr<Part>> parts_;
  uint64_t own_ = 0;     ///< points, triangles and references of what is built, once each
  LookNumbers numbers_;  ///< of the part that is being made
};

}  // namespace

bool is_3mf_path(const std::string& path) { return has_ending(path, ".3mf"); }

Result<std::vector<ModelPart>> parse_3mf(const std::string& name, std::string_view bytes,
                                         std::vector<std::string>* notes, FileUnit unit) {
  auto archive = ZipArchive::open(name, bytes);
  if (!archive) return archive.error();
  std::vector<std::string> own_notes;
  auto parts = PackageReader(name, *std::move(archive), &own_notes, unit).read();
  if (!parts) return parts;
  for (ModelPart& part : *parts) {
    part.mesh.kind = name;
    part.mesh.keep_facets = true;
  }
  if (notes != nullptr) {
    for (const std::string& note : own_notes) notes->push_back(name + ": " + note);
  }
  return parts;
}

}  // namespace csgrun
