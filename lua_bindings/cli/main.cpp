// csgrun: from a model to a mesh.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include <unistd.h>

#include <csgrun/engine/heap.h>

#include "lua_bindings/api.h"
#include "lua_bindings/api_docs.h"
#include "lua_bindings/cli/alike.h"
#include "lua_bindings/cli/exit_codes.h"
#include "lua_bindings/cli/info.h"
#include "lua_bindings/cli/init.h"
#include "lua_bindings/cli/options.h"
#include "lua_bindings/cli/parameter_file.h"
#include "lua_bindings/cli/report.h"
#include "lua_bindings/cli/run_model.h"

namespace {

void print(std::FILE* stream, const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stream);
}

int run(const csgrun::CommandLine& line, csgrun::RunReport& report) {
  const csgrun::Failure failure = csgrun::run_model(line, report);
  // The error first: it says where. Warnings often say why, and no JSON object will have them.
  if (failure.failed()) print(stderr, failure.message + "\n");
  if (!line.quiet && (line.stats != csgrun::StatsForm::kJson || failure.failed())) {
    for (const std::string& warning : csgrun::few_alike(report.warnings)) {
      print(stderr, "warning: " + warning + "\n");
    }
  }
  // A failed check is a finding: the measures and the verdict are told all the same.
  if (failure.failed() && !report.check_failed) return failure.code;
  if (line.list_params) print(stdout, csgrun::parameters_json(line.model, report.parameters));
  if (line.stats == csgrun::StatsForm::kJson) print(stdout, csgrun::stats_json(report));
  if (line.stats == csgrun::StatsForm::kText) print(stderr, csgrun::stats_text(report));
  return failure.code;
}

int info(const csgrun::CommandLine& line) {
  std::string output;
  std::vector<std::string> notes;
  const csgrun::Failure failure = csgrun::run_info(line.model, line.info_json, output, notes);
  for (const std::string& note : csgrun::few_alike(notes)) {
    print(stderr, "warning: " + note + "\n");
  }
  if (failure.failed()) {
    print(stderr, failure.message + "\n");
    return failure.code;
  }
  print(stdout, output);
  return csgrun::kExitGood;
}

int execute(const csgrun::CommandLine& line, csgrun::RunReport& report) {
  switch (line.command) {
    case csgrun::Command::kRun:
      return run(line, report);
    case csgrun::Command::kInfo:
      return info(line);
    case csgrun::Command::kHelpApi:
      print(stdout, line.api_form == csgrun::ApiForm::kMarkdown      ? csgrun::api_markdown()
                    : line.api_form == csgrun::ApiForm::kDefinitions ? csgrun::api_definitions()
                    : line.api_form == csgrun::ApiForm::kJson        ? csgrun::api_json()
                                                                     : csgrun::api_help());
      return csgrun::kExitGood;
    case csgrun::Command::kInit: {
      const csgrun::Failure failure = csgrun::init_folder();
      if (failure.failed()) print(stderr, failure.message + "\n");
      return failure.code;
    }
    case csgrun::Command::kDone:
      return line.exit_code;
  }
  return csgrun::kExitGood;
}

/// Writes out what was printed. What could not be, as on a full disk, is an error.
int flush(int code) {
  const bool was_lost = std::ferror(stdout) != 0;
  if (std::fflush(stdout) == 0 && !was_lost) return code;
  const std::string reason = was_lost ? "" : std::string(": ") + std::strerror(errno);
  print(stderr, "csgrun: cannot write standard output" + reason + "\n");
  return code == csgrun::kExitGood ? csgrun::kExitFiles : code;
}

/// Ends the process as it stands: the system takes back all that it has at once.
[[noreturn]] void leave(int code) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  std::exit(code);  // which looks for leaks, and tells of what was found
#else
  _exit(code);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  csgrun::keep_freed_memory();
  // A file that grows over a limit is an error of that file, not the end of the program.
  std::signal(SIGXFSZ, SIG_IGN);
  csgrun::map_program();
  const csgrun::CommandLine line = csgrun::parse_command_line(argc, argv);
  csgrun::RunReport report;
  leave(flush(execute(line, report)));
}
