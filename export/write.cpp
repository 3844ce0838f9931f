#include <exception>
#include <new>

#include <csgrun/export/write.h>

#include "export/atomic_file.h"
#include "export/encoders.h"

namespace csgrun {
namespace {

bool is_known(const std::string& format) {
  for (const char* known : {"glb", "gltf", "stl", "obj", "off"}) {
    if (format == known) return true;
  }
  return false;
}

Status check_parts(const std::string& format, const std::vector<Part>& parts) {
  if (!is_known(format)) {
    return Error{ErrorCode::kInvalidArgument, "there is no model format '" + format + "'", {}};
  }
  for (const Part& part : parts) {
    if (!part.solid)
      return Error{ErrorCode::kInternal, "part '" + part.name + "' has no solid", {}};
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

Result<std::string> encode_checked(const std::string& format, const std::vector<Part>& parts,
                                   WriteReport& report) {
  if (format == "glb") return encode_gltf(parts, GltfContainer::kBinary, report);
  if (format == "gltf") return encode_gltf(parts, GltfContainer::kText, report);
  if (format == "stl") return encode_stl(parts[0], report);
  if (format == "off") return encode_off(parts[0], report);
  Result<ObjFiles> files = encode_obj(parts, "", report);
  if (!files) return files.error();
  return std::move(files->obj);
}

/// An .obj and the .mtl beside it. The materials are there before anything names them.
Status write_obj(const std::string& path, const std::vector<Part>& parts, WriteReport& report) {
  const std::string mtl_path = path.substr(0, path.size() - 4) + ".mtl";
  const std::string mtl_name = mtl_path.substr(mtl_path.rfind('/') + 1);
  Result<ObjFiles> files = encode_obj(parts, mtl_name, report);
  if (!files) return files.error();
  AtomicFile mtl, obj;
  if (Status status = mtl.write(mtl_path, files->mtl); !status) return status;
  if (Status status = obj.write(path, files->obj); !status) return status;
  if (Status status = mtl.commit(); !status) return status;
  return obj.commit();
}

}  // namespace

std::string model_format_of(const std::string& path) {
  const size_t dot = path.find_last_of("./");
  if (dot == std::string::npos || path[dot] != '.') return {};
  std::string ending = path.substr(dot + 1);
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return is_known(ending) ? ending : std::string();
}

bool keeps_parts(const std::string& format) {
  return format == "glb" || format == "gltf" || format == "obj";
}

Result<WriteReport> write_model(const std::string& path, const std::vector<Part>& parts) {
  const std::string format = model_format_of(path);
  if (format.empty()) {
    return Error{ErrorCode::kInvalidArgument,
                 "'" + path + "' does not end in .glb, .gltf, .stl, .obj or .off",
                 {}};
  }
  if (Status status = check_parts(format, parts); !status) return status.error();
  WriteReport report;
  const auto write = [&]() -> Status {
    if (format == "obj") return write_obj(path, parts, report);
    Result<std::string> bytes = encode_checked(format, parts, report);
    if (!bytes) return bytes.error();
    AtomicFile file;
    if (Status status = file.write(path, *bytes); !status) return status;
    return file.commit();
  };
  if (Status status = guarded(write); !status) return status.error();
  return report;
}

Result<std::string> encode_model(const std::string& format, const std::vector<Part>& parts,
                                 WriteReport& report) {
  if (Status status = check_parts(format, parts); !status) return status.error();
  return guarded([&] { return encode_checked(format, parts, report); });
}

}  // namespace csgrun
