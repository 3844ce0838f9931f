#include <algorithm>
#include <array>
#include <exception>
#include <new>

#include <csgrun/export/write.h>

#include "export/atomic_file.h"
#include "export/encoders.h"
#include "export/mesh_maker.h"

namespace csgrun {
namespace {

constexpr std::array kFormats{"glb", "gltf", "stl", "3mf", "obj", "off", "ply", "exact.json"};

Status check_parts(const std::string& format, const std::vector<Part>& parts) {
  if (std::find(kFormats.begin(), kFormats.end(), format) == kFormats.end()) {
    return Error{ErrorCode::kInvalidArgument, "there is no model format '" + format + "'", {}};
  }
  for (const Part& part : parts) {
    if (!part.solid) {
      return Error{ErrorCode::kInvalidArgument, "part '" + part.name + "' has no solid", {}};
    }
  }
  if (!keeps_parts(format) && parts.size() != 1) {
    return Error{
        ErrorCode::kInvalidArgument,
        "a ." + format + " file holds one solid, not " + std::to_string(parts.size()) + " parts",
        {}};
  }
  return std::monostate{};
}

/// Runs a writer; exceptions of the standard library and of tinygltf's JSON stop here.
template <class Function>
auto guarded(const Function& function) -> decltype(function()) {
  try {
    return function();
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kLimit, "not enough memory to write the model", {}};
  } catch (const std::exception& exception) {
    return Error{ErrorCode::kInternal, std::string("writing failed: ") + exception.what(), {}};
  }
}

/// The files of a model whose parts were checked against the format.
Result<std::vector<ModelFile>> encode(const std::string& path, const std::string& format,
                                      const std::vector<Part>& parts, MeshMaker& maker) {
  if (format == "obj") {
    const std::string mtl_path = path.empty() ? "" : path.substr(0, path.size() - 4) + ".mtl";
    Result<ObjFiles> files = encode_obj(parts, mtl_path.substr(mtl_path.rfind('/') + 1), maker);
    if (!files) return files.error();
    // The materials are there before anything names them.
    std::vector<ModelFile> both;
    if (!path.empty()) both.push_back({mtl_path, std::move(files->mtl)});
    both.push_back({path, std::move(files->obj)});
    return both;
  }
  Result<std::string> bytes = [&] {
    if (format == "glb") return encode_gltf(parts, GltfContainer::kBinary, maker);
    if (format == "gltf") return encode_gltf(parts, GltfContainer::kText, maker);
    if (format == "stl") return encode_stl(parts[0], maker);
    if (format == "off") return encode_off(parts[0], maker);
    if (format == "ply") return encode_ply(parts[0], maker);
    if (format == "3mf") return encode_3mf(parts, maker);
    return encode_exact(parts);
  }();
  if (!bytes) return bytes.error();
  std::vector<ModelFile> file;  // one, which a list of initial values would copy
  file.push_back({path, *std::move(bytes)});
  return file;
}

}  // namespace

std::string model_format_of(const std::string& path) {
  std::string lower = path;
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  for (const char* known : kFormats) {
    const std::string ending = std::string(".") + known;
    if (lower.ends_with(ending)) return known;
  }
  return {};
}

bool keeps_parts(const std::string& format) {
  return format == "glb" || format == "gltf" || format == "3mf" || format == "obj" ||
         format == "exact.json";
}

Result<std::vector<ModelFile>> encode_files(const std::string& path, const std::vector<Part>& parts,
                                            const WriteOptions& options, WriteReport& report) {
  const std::string format = model_format_of(path);
  if (format.empty()) {
    return Error{
        ErrorCode::kInvalidArgument,
        "'" + path + "' does not end in .glb, .gltf, .stl, .3mf, .obj, .off, .ply or .exact.json",
        {}};
  }
  if (Status status = check_parts(format, parts); !status) return status.error();
  MeshMaker maker(options, report);
  return guarded([&] { return encode(path, format, parts, maker); });
}

Status write_files(const std::vector<ModelFile>& files) {
  return guarded([&]() -> Status {
    std::vector<AtomicFile> under_way(files.size());
    for (size_t i = 0; i < files.size(); ++i) {
      if (Status status = under_way[i].write(files[i].path, files[i].bytes); !status) return status;
    }
    for (AtomicFile& file : under_way) {
      if (Status status = file.commit(); !status) return status;
    }
    return std::monostate{};
  });
}

Result<WriteReport> write_model(const std::string& path, const std::vector<Part>& parts) {
  WriteReport report;
  const auto files = encode_files(path, parts, {}, report);
  if (!files) return files.error();
  if (Status status = write_files(*files); !status) return status.error();
  return report;
}

Result<std::string> encode_model(const std::string& format, const std::vector<Part>& parts,
                                 WriteReport& report) {
  if (Status status = check_parts(format, parts); !status) return status.error();
  MeshMaker maker({}, report);
  auto files = guarded([&] { return encode("", format, parts, maker); });
  if (!files) return files.error();
  return std::move(files->back().bytes);
}

}  // namespace csgrun
