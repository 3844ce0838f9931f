// A fuzz target without libFuzzer: all kept inputs, then random mutations of them from a fixed
// seed.
//
// usage: fuzz_NAME NAME RUNS FOLDER     as ctest has it; FOLDER holds corpus/, regress/ and dict/
//        fuzz_NAME FILE...              these inputs
// CSGRUN_FUZZ_RUNS=n asks for more mutations, CSGRUN_SEED=n for others. An input that ends the
// process is written to ./finding-NAME.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "tests/fuzz/checks.h"
#include "tests/fuzz/mutator.h"

namespace {

namespace fs = std::filesystem;

constexpr unsigned kSecondsPerInput = 120;
constexpr uint64_t kSeed = 20100508;

#ifdef __SANITIZE_ADDRESS__
// The sanitizer reports the others, and ends by the first.
constexpr int kFatal[] = {SIGABRT, SIGALRM};
#else
constexpr int kFatal[] = {SIGABRT, SIGALRM, SIGSEGV, SIGBUS, SIGFPE, SIGILL};
#endif

// What the handler of a crash needs. It may allocate nothing.
std::string finding_path;
const uint8_t* current = nullptr;
size_t current_size = 0;

void save_finding() {
  const int file = ::open(finding_path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) return;
  bool written = true;
  for (size_t done = 0; done < current_size && written;) {
    const ssize_t step = ::write(file, current + done, current_size - done);
    written = step > 0;
    if (written) done += static_cast<size_t>(step);
  }
  ::close(file);
}

void on_signal(int signal) {
  save_finding();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

std::string read_all(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The files of a folder by name; none if there is no such folder.
std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The quoted words of a dictionary of libFuzzer, with \xAB, \\ and \" resolved.
std::vector<std::string> words_of(const fs::path& dictionary) {
  std::vector<std::string> words;
  std::istringstream lines(read_all(dictionary));
  for (std::string line; std::getline(lines, line);) {
    const size_t first = line.find('"'), last = line.rfind('"');
    if (line.empty() || line[0] == '#' || first == last) continue;
    std::string word;
    for (size_t i = first + 1; i < last; ++i) {
      if (line[i] == '\\' && i + 3 < last && line[i + 1] == 'x') {
        word += static_cast<char>(std::stoi(line.substr(i + 2, 2), nullptr, 16));
        i += 3;
      } else {
        if (line[i] == '\\') ++i;
        word += line[i];
      }
    }
    words.push_back(word);
  }
  return words;
}

void run(const std::string& input) {
  // In a block of exactly its size, so that AddressSanitizer sees what reads beyond.
  const auto bytes = std::make_unique<uint8_t[]>(input.size());
  std::copy(input.begin(), input.end(), bytes.get());
  current = bytes.get();
  current_size = input.size();
  ::alarm(kSecondsPerInput);
  LLVMFuzzerTestOneInput(bytes.get(), input.size());
  ::alarm(0);
}

int replay(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    std::printf("%s\n", path.c_str());
    std::fflush(stdout);
    run(read_all(path));
  }
  return 0;
}

}  // namespace

#ifdef __SANITIZE_ADDRESS__
extern "C" const char* __asan_default_options() { return "abort_on_error=1"; }
#endif

int main(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool folder_given = arguments.size() == 3 && fs::is_directory(arguments[2]);
  finding_path = "finding-" + (folder_given ? arguments[0] : fs::path(argv[0]).filename().string());
  for (const int signal : kFatal) std::signal(signal, on_signal);
  if (!folder_given) return replay(arguments);

  const std::string name = arguments[0];
  const fs::path folder = arguments[2];
  std::vector<std::string> inputs;
  for (const char* kind : {"corpus", "regress"}) {
    for (const fs::path& path : files_in(folder / kind / name)) inputs.push_back(read_all(path));
  }
  if (inputs.empty()) {
    std::fprintf(stderr, "no inputs in %s\n", (folder / "corpus" / name).c_str());
    return 1;
  }
  for (const std::string& input : inputs) run(input);

  const char* more = std::getenv("CSGRUN_FUZZ_RUNS");
  const long runs = std::atol(more != nullptr ? more : arguments[1].c_str());
  csgrun::test::Random random(kSeed);
  const auto words = words_of(folder / "dict" / (name + ".dict"));
  csgrun::fuzz::Mutator mutator(random, inputs, words);
  for (long i = 0; i < runs; ++i) run(mutator.next());
  std::printf("%zu kept inputs, %ld mutations\n", inputs.size(), runs);
  return 0;
}
