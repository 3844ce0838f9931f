#include "lua_bindings/cli/run_model.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>
#include <thread>

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <csgrun/engine/heap.h>
#include <csgrun/export/write_flat.h>
#include <csgrun/primitives/csg_file.h>
#include <csgrun/primitives/flat_file.h>

#include "lua_bindings/cli/check_text.h"
#include "lua_bindings/cli/instances.h"
#include "lua_bindings/cli/output_paths.h"
#include "lua_bindings/cli/progress.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/model_parts.h"
#include "lua_bindings/script.h"

namespace csgrun {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// As many threads as the process may use (affinity counts, not only the machine).
unsigned usable_threads() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) == 0)
    return static_cast<unsigned>(std::max(1, CPU_COUNT(&set)));
  return std::max(1u, std::thread::hardware_concurrency());
}

FileText read_standard_input() {
  FileText text;
  char block[65536];
  ssize_t got = 0;
  while ((got = ::read(STDIN_FILENO, block, sizeof block)) > 0)
    text.bytes.append(block, static_cast<size_t>(got));
  if (got < 0) text.error = std::strerror(errno);  // half a script would be another one
  return text;
}

class Run {
 public:
  /// `memory`: the bytes that the process may have.
  Run(const CommandLine& line, RunReport& report, size_t memory)
      : line_(line), report_(report), session_(session_options(line, memory)) {}

  Failure execute() {
    const auto start = Clock::now();
    Failure failure = check_folders();
    if (!failure.failed()) failure = load();
    report_.script_seconds = seconds_since(start) - session_.budget().evaluation_seconds();
    if (line_.list_params) {
      if (!failure.failed()) {
        report_.parameters = session_.parameters;
      } else {
        report_.warnings = session_.warnings();
      }
      session_.budget().stop();
      return failure;
    }
    if (!failure.failed()) failure = check_time();
    if (!failure.failed()) failure = check_dimensions();
    if (!failure.failed()) failure = is_flat() ? take_shapes() : evaluate();
    if (!failure.failed()) failure = check_time();
    if (!failure.failed()) failure = write_all();
    session_.budget().stop();
    report_.stats = session_.evaluation_stats();
    const auto& own = session_.warnings();
    const auto evaluation = session_.evaluation_warnings();
    report_.warnings.insert(report_.warnings.begin(), evaluation.begin(), evaluation.end());
    report_.warnings.insert(report_.warnings.begin(), own.begin(), own.end());
    report_.threads = session_.options().evaluate.threads;
    report_.total_seconds = seconds_since(start);
    return failure;
  }

 private:
  /// As many as have their stacks, of a few megabytes each, in a small part of the memory.
  static unsigned most_threads(size_t memory) {
    constexpr size_t kOfThread = size_t{32} << 20;
    return static_cast<unsigned>(std::clamp<size_t>(memory / kOfThread, 1, 1024));
  }

  static SessionOptions session_options(const CommandLine& line, size_t memory) {
    SessionOptions options;
    options.model = line.model == "-" ? "stdin" : line.model;
    options.model_folder = folder_of(line.model);
    options.library_folders = line.library_folders;
    options.definitions = line.definitions;
    options.facets = line.facets;
    options.evaluate.threads =
        std::min(line.threads != 0 ? line.threads : usable_threads(), most_threads(memory));
    options.evaluate.grid = line.grid;
    options.evaluate.disk_cache = line.disk_cache;
    options.evaluate.progress = make_progress(line.quiet);
    options.evaluate.exact_points = std::any_of(
        line.outputs.begin(), line.outputs.end(),
        [](const std::string& output) { return model_format_of(output) == "exact.json"; });
    options.fonts.system_fonts = line.system_fonts;
    options.fonts.strict = line.strict;
    options.before_evaluation = [memory] { make_room_for_meshes(HeapPages::kMeasured, memory); };
    options.limits.total_seconds = line.timeout_seconds;
    if (line.memory_bytes)
      options.limits.heap_bytes = std::min(options.limits.heap_bytes, *line.memory_bytes);
    return options;
  }

  /// Told before anything is evaluated: that there is no folder to write to.
  Failure check_folders() const {
    for (const std::string& output : line_.outputs) {
      const std::string folder = std::filesystem::path(output).parent_path().string();
      std::error_code ignored;
      if (folder.empty() || folder.find("%s") != std::string::npos ||
          std::filesystem::is_directory(folder, ignored))
        continue;
      return {kExitFiles,
              fmt::format("csgrun: cannot write '{}': there is no folder '{}'", output, folder)};
    }
    return {};
  }

  /// MODEL to the parts of the session.
  Failure load() {
    const bool is_standard_input = line_.model == "-";
    const FileText text = is_standard_input ? read_standard_input() : read_whole_file(line_.model);
    if (!text.error.empty()) {
      return {
          kExitFiles,
          fmt::format("csgrun: cannot read {}: {}",
                      is_standard_input ? "standard input" : "'" + line_.model + "'", text.error)};
    }
    if (!model_file_format_of(line_.model).empty()) return load_mesh(text.bytes);
    if (!flat_file_format_of(line_.model).empty()) return load_flat(text.bytes);
    if (is_csg_path(line_.model)) return load_csg(text.bytes);
    return load_script(text.bytes);
  }

  Failure load_csg(const std::string& text) {
    if (Failure failure = refuse_definitions(); failure.failed()) return failure;
    // Places go into written files, so they are seen from the tree's own folder; messages are not.
    const SourceRef where = session_.source_ref(line_.model, 1);
    const std::string folder = folder_of(line_.model);
    CsgEnvironment environment;
    environment.evaluator = &session_.evaluator();
    environment.fonts = &session_.fonts();
    environment.file = where.file;
    environment.facets = line_.facets;
    environment.read = [this](const std::string& path) -> Result<std::string> {
      try {
        return session_.files().open(line_.model, path).bytes;
      } catch (const ScriptError& error) {
        return Error{ErrorCode::kMalformedFile, error.what(), {}};
      }
    };
    bool evaluation_failed = false;
    environment.evaluation_failed = &evaluation_failed;
    const EvaluationScope scope(session_.budget());
    auto model = parse_csg(*where.file, text, environment);
    if (!model) {
      if (model.error().code == ErrorCode::kCancelled) return evaluation_failure(model.error());
      const std::string place = model.error().where.text();
      return {
          evaluation_failed ? kExitGeometry : kExitScript,
          (place.empty() ? line_.model : join_path(folder, place)) + ": " + model.error().message};
    }
    for (const std::string& warning : model->warnings)
      report_.warnings.push_back(join_path(folder, warning));
    if (model->is_2d) {
      session_.add_part({"", nullptr, model->shape, where, false, model->appearance}, "");
    } else {
      session_.add_part({"", model->solid, {}, where}, "");
    }
    session_.name_unnamed_parts();
    return {};
  }

  Failure load_script(const std::string& text) {
    const ScriptOutcome outcome = run_script(session_, session_.options().model, text);
    switch (outcome.status) {
      case ScriptStatus::kGood:
        return {};
      case ScriptStatus::kFailed:
        return {kExitScript, outcome.message};
      case ScriptStatus::kGeometry:
        return {kExitGeometry, outcome.message};
      case ScriptStatus::kUsage:
        return {kExitUsage, "csgrun: " + outcome.message};
      case ScriptStatus::kOutOfTime:
        return {kExitTime, outcome.message};
    }
    return {};
  }

  Failure load_mesh(const std::string& bytes) {
    if (Failure failure = refuse_definitions(); failure.failed()) return failure;
    if (line_.facets != Facets())
      return {kExitUsage, "csgrun: --fn, --fa and --fs: the facets of a mesh are what they are"};
    ModelPartOptions options;
    std::vector<std::string> notes;
    options.open = [&](const std::string& name) -> Result<std::string> {
      const std::string path = join_path(folder_of(line_.model), name);
      FileText text = read_whole_file(path);
      session_.files().note(path);
      if (text.error.empty()) return std::move(text.bytes);
      return Error{
          ErrorCode::kCannotRead, fmt::format("cannot read '{}': {}", name, text.error), {}};
    };
    auto parts = read_model_parts(line_.model, bytes, options, &notes);
    if (!parts) {
      const std::string& message = parts.error().message;
      return {kExitScript,
              message.rfind(line_.model, 0) == 0 ? message : line_.model + ": " + message};
    }
    // Notes begin with the file's name.
    report_.warnings.insert(report_.warnings.end(), notes.begin(), notes.end());
    const SourceRef where = session_.source_ref(line_.model, 1);
    const auto leaf = [&](PolygonMesh mesh) {
      mesh.kind = session_.files().name_from_folder(line_.model);
      return Node::leaf(std::make_shared<const PolygonMesh>(std::move(mesh)), where);
    };
    for (const SolidPart& part : solid_parts_of(*std::move(parts), where, leaf)) {
      try {
        session_.add_part({part.name, part.node, {}, where}, "");
      } catch (const ScriptError& error) {
        return {kExitScript, line_.model + ": " + error.what()};
      }
    }
    session_.name_unnamed_parts();
    return {};
  }

  Failure load_flat(const std::string& bytes) {
    if (Failure failure = refuse_definitions(); failure.failed()) return failure;
    FlatFileOptions options;
    options.facets = line_.facets;
    auto file = parse_flat(line_.model, bytes, options);
    if (!file) {
      const std::string& message = file.error().message;
      return {kExitScript,
              message.rfind(line_.model, 0) == 0 ? message : line_.model + ": " + message};
    }
    report_.warnings.insert(report_.warnings.end(), file->notes.begin(), file->notes.end());
    const SourceRef where = session_.source_ref(line_.model, 1);
    session_.add_part({"", nullptr, std::move(file->shape), where}, "");
    session_.name_unnamed_parts();
    return {};
  }

  /// Meshes and trees have no parameters.
  Failure refuse_definitions() const {
    if (line_.definitions.empty()) return {};
    return {kExitUsage, fmt::format("csgrun: {} {}: only a script has parameters",
                                    line_.definitions[0].origin, line_.definitions[0].name)};
  }

  /// What ended before it looked at the clock again is late all the same.
  Failure check_time() { return session_.budget().out_of_time() ? late() : Failure{}; }
  Failure late() {
    return {kExitTime, fmt::format("{}: {} in evaluation", session_.options().model,
                                   session_.budget().time_message())};
  }

  Failure evaluation_failure(const Error& error) {
    if (error.code == ErrorCode::kCancelled) return late();
    std::string place = session_.place_text(error.where);
    // A mesh has no lines to speak of.
    if (place.empty() || !model_file_format_of(line_.model).empty())
      place = session_.options().model;
    return {kExitGeometry, place + ": " + error.message};
  }

  /// Whether the parts are shapes. All are, or none: see check_dimensions.
  [[nodiscard]] bool is_flat() const { return session_.parts()[0].solid == nullptr; }

  [[nodiscard]] std::string place_of(const ScriptPart& part) const {
    const std::string place = session_.place_text(part.where);
    return place.empty() ? session_.options().model : place;
  }

  /// Shapes go into drawings, solids into meshes.
  Failure check_dimensions() const {
    const auto& parts = session_.parts();
    for (const ScriptPart& part : parts) {
      const bool flat = part.solid == nullptr;
      if (flat != is_flat()) {
        return {kExitScript,
                fmt::format("{}: part '{}' is a {}, but part '{}' is a {}: no file holds both; "
                            "linear_extrude makes a solid of a shape, project a shape of a solid",
                            place_of(part), part.name, flat ? "2D shape" : "solid", parts[0].name,
                            flat ? "solid" : "2D shape")};
      }
      for (const std::string& output : line_.outputs) {
        const bool drawing = !flat_format_of(output).empty();
        if (flat && !drawing) {
          return {kExitScript,
                  fmt::format("{}: part '{}' is a 2D shape, and '{}' holds solids; make a solid of "
                              "it with linear_extrude or rotate_extrude, or write .svg or .dxf",
                              place_of(part), part.name, output)};
        }
        // An OpenSCAD tree that comes to nothing has no dimension.
        if (!flat && drawing && is_csg_path(line_.model) && part.solid->kind() == NodeKind::kEmpty)
          return {kExitGeometry, place_of(part) + ": the result is empty"};
        if (!flat && drawing) {
          return {kExitScript,
                  fmt::format("{}: part '{}' is a solid, and '{}' holds 2D shapes; make a shape of "
                              "it with project",
                              place_of(part), part.name, output)};
        }
      }
    }
    return {};
  }

  /// The parts of a drawing, to be written and measured.
  Failure take_shapes() {
    std::vector<std::string> empty;
    for (const ScriptPart& part : session_.parts()) {
      report_.flat_parts.push_back({part.name, part.shape});
      if (part.shape.empty())
        empty.push_back(place_of(part) + ": part '" + part.name + "' is empty");
    }
    if (empty.size() == report_.flat_parts.size()) {
      return {kExitGeometry, place_of(session_.parts()[0]) + ": the result is empty"};
    }
    report_.warnings.insert(report_.warnings.end(), empty.begin(), empty.end());
    return {};
  }

  Failure write_drawing(const std::string& path, const std::vector<FlatPart>& parts) {
    auto bytes = encode_flat(flat_format_of(path), parts);
    if (!bytes) return {kExitFiles, "csgrun: " + bytes.error().message};
    return put({{path, *std::move(bytes)}});
  }

  Failure write_flat(const std::string& output) {
    std::vector<FlatPart> parts;
    for (const ScriptPart& part : session_.parts()) {
      if (part.shape.empty()) continue;
      FlatPart flat{part.name, part.shape.loops(), {}};
      if (const auto& a = part.appearance) flat.color = {a->red, a->green, a->blue, a->alpha};
      parts.push_back(std::move(flat));
    }
    if (!is_pattern(output)) return write_drawing(output, parts);
    for (const FlatPart& part : parts) {
      Failure failure = write_drawing(path_of_part(output, part.name), {part});
      if (failure.failed()) return failure;
    }
    return {};
  }

  Failure evaluate() {
    std::vector<NodePtr> nodes;
    for (const ScriptPart& part : session_.parts()) {
      nodes.push_back(part.solid);
    }
    const Instances instances = wants_instances() ? find_instances(nodes) : Instances{};
    const size_t part_count = nodes.size();
    nodes.insert(nodes.end(), instances.bases.begin(), instances.bases.end());
    const EvaluationScope scope(session_.budget());
    // Written files tell nothing of measures.
    const Measuring measuring =
        line_.stats == StatsForm::kNone ? Measuring::kNothing : Measuring::kButTheCentre;
    auto solids = session_.evaluator().evaluate(nodes, measuring);
    clear_progress();
    if (!solids) return evaluation_failure(solids.error());
    std::vector<std::string> empty;
    for (size_t i = 0; i < part_count; ++i) {
      const ScriptPart& part = session_.parts()[i];
      report_.parts.push_back({part.name, (*solids)[i], {}});
      placed_parts_.push_back(report_.parts.back());
      if (!instances.bases.empty() && instances.of_part[i]) {
        placed_parts_.back().solid = (*solids)[part_count + instances.of_part[i]->base];
        placed_parts_.back().placement = instances.of_part[i]->placement;
      }
      if (!(*solids)[i]->empty()) continue;
      const std::string place = session_.place_text(part.where);
      empty.push_back((place.empty() ? "" : place + ": ") + "part '" + part.name + "' is empty");
    }
    if (empty.size() < part_count) {
      report_.warnings.insert(report_.warnings.end(), empty.begin(), empty.end());
      return {};
    }
    const std::string place = session_.place_text(session_.parts()[0].where);
    return {kExitGeometry,
            (place.empty() ? session_.options().model : place) + ": the result is empty"};
  }

  /// glTF knows meshes that stand in several places.
  static bool knows_instances(const std::string& output) {
    const std::string format = model_format_of(output);
    return format == "glb" || format == "gltf";
  }
  [[nodiscard]] bool wants_instances() const {
    return std::any_of(line_.outputs.begin(), line_.outputs.end(), knows_instances);
  }

  /// Those of the parts that have something in them; what is empty was warned of.
  static std::vector<Part> with_content(const std::vector<Part>& all) {
    std::vector<Part> parts;
    for (const Part& part : all) {
      if (!part.solid->empty()) parts.push_back(part);
    }
    return parts;
  }

  /// The exact union of all parts, as one part; made once.
  Failure join(std::vector<Part>& joined) {
    if (joined_.empty()) {
      std::vector<NodePtr> nodes;
      for (const ScriptPart& part : session_.parts()) nodes.push_back(part.solid);
      const EvaluationScope scope(session_.budget());
      auto solid = session_.evaluator().evaluate(Node::boolean(BooleanOp::kUnion, nodes),
                                                 Measuring::kNothing);
      clear_progress();
      if (!solid) return evaluation_failure(solid.error());
      joined_.push_back({"model", *solid, {}});
    }
    joined = joined_;
    return {};
  }

  /// What the model was made of is not replaced by what is made of it.
  [[nodiscard]] Failure check_source(const std::string& path) const {
    const auto& sources = session_.files().sources();
    const bool is_source =
        std::any_of(sources.begin(), sources.end(),
                    [&](const std::string& source) { return is_same_file(path, source); });
    if (!is_source) return {};
    return {kExitUsage,
            fmt::format("csgrun: '{}' is read by the model and would be overwritten", path)};
  }

  Failure write_all() {
    const auto start = Clock::now();
    const EvaluationScope scope(session_.budget());
    Failure failure;
    for (const std::string& output : line_.outputs) {
      if (failure = check_source(output); failure.failed()) return failure;
    }
    if (const std::string clash = find_clash(line_.outputs, written_names()); !clash.empty())
      return {kExitFiles, "csgrun: " + clash};
    for (const std::string& output : line_.outputs) {
      failure = is_flat()            ? write_flat(output)
                : is_pattern(output) ? write_each(output)
                                     : write_one(output);
      if (failure.failed()) break;
    }
    // With a check nothing was written yet: one bad mesh, and there is no file.
    if (!failure.failed()) failure = failure_of_checks();
    for (const auto& model : checked_models_) {
      if (!failure.failed()) failure = put(model);
    }
    report_.export_seconds = seconds_since(start);
    return failure;
  }

  Failure failure_of_checks() {
    for (const FileCheck& check : report_.checks) {
      for (const MeshCheck& mesh : check.meshes) {
        if (mesh.verdict != CheckVerdict::kFailed) continue;
        report_.check_failed = true;
        return {kExitGeometry, fmt::format("{}: --check: {}: {}; nothing was written",
                                           session_.options().model, check.file, check_text(mesh))};
      }
    }
    return {};
  }

  Failure write_one(const std::string& output) {
    std::vector<Part> parts = with_content(knows_instances(output) ? placed_parts_ : report_.parts);
    if (!keeps_parts(model_format_of(output)) && session_.parts().size() > 1) {
      if (Failure failure = join(parts); failure.failed()) return failure;
    }
    return write(output, parts);
  }

  /// Of the parts that have something in them.
  [[nodiscard]] std::vector<std::string> written_names() const {
    std::vector<std::string> names;
    for (const Part& part : with_content(report_.parts)) names.push_back(part.name);
    for (const auto& part : report_.flat_parts) {
      if (!part.shape.empty()) names.push_back(part.name);
    }
    return names;
  }

  Failure write_each(const std::string& pattern) {
    for (const Part& part : with_content(report_.parts)) {
      Failure failure = write(path_of_part(pattern, part.name), {part});
      if (failure.failed()) return failure;
    }
    return {};
  }

  Failure write(const std::string& path, const std::vector<Part>& parts) {
    WriteOptions options;
    options.check = line_.check;
    options.threads = session_.options().evaluate.threads;
    options.cancel = &session_.budget().cancel();
    options.repairing = make_repair_progress(line_.quiet);
    WriteReport report;
    auto files = encode_files(path, parts, options, report);
    clear_progress();
    if (!files) {
      if (files.error().code == ErrorCode::kCancelled) return evaluation_failure(files.error());
      return {kExitFiles, "csgrun: " + files.error().message};
    }
    for (const std::string& warning : report.warnings)
      report_.warnings.push_back(path + ": " + warning);
    if (!line_.check) return put(*files);
    for (const MeshCheck& check : report.checks) {
      // A part that rounding left nothing of was warned of already.
      const bool lost = check.vanished > 0 && check.triangles[1] > 0;
      if (check.verdict == CheckVerdict::kRepaired ||
          (check.verdict == CheckVerdict::kClean && lost))
        report_.warnings.push_back(path + ": " + check_text(check));
    }
    report_.checks.push_back({path, std::move(report.checks)});
    checked_models_.push_back(*std::move(files));
    return {};
  }

  Failure put(const std::vector<ModelFile>& files) {
    if (Failure failure = check_time(); failure.failed()) return failure;
    for (const ModelFile& file : files) {
      if (Failure failure = check_source(file.path); failure.failed()) return failure;
    }
    if (const Status written = write_files(files); !written)
      return {kExitFiles, "csgrun: " + written.error().message};
    return {};
  }

  const CommandLine& line_;
  RunReport& report_;
  Session session_;
  std::vector<Part> placed_parts_;  // the parts of the report, as bases and placements
  std::vector<Part> joined_;
  std::vector<std::vector<ModelFile>> checked_models_;  // that wait for the verdict on all of them
};

}  // namespace

Failure run_model(const CommandLine& line, RunReport& report) {
  const size_t memory = line.memory_bytes.value_or(default_process_memory());
  limit_process_memory(memory);
  try {
    const auto run = std::make_shared<Run>(line, report, memory);
    report.run = run;
    return run->execute();
  } catch (const std::bad_alloc&) {
    report.run.reset();  // then there is memory for the message
    return {kExitGeometry, fmt::format("{}: not enough memory in evaluation (limit {} MB)",
                                       line.model, memory >> 20)};
  }
}

}  // namespace csgrun
