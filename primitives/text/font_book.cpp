// From a font's description to a face. Descriptions are those of fontconfig as far as OpenSCAD's
// users write them: a family, then ":style=Bold Italic" or ":bold".
#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "primitives/base/text.h"
#include "primitives/files/formats.h"
#include "primitives/files/read_file.h"
#include "primitives/text/font.h"

namespace csgrun {
namespace {

constexpr const char* kShippedFamily = "liberation sans";

std::string lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

std::string trimmed(const std::string& text) {
  const size_t begin = text.find_first_not_of(" \t"), end = text.find_last_not_of(" \t");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

struct Description {
  std::string family, style;  ///< in lower case; the style of "family:bold" is "bold"
  [[nodiscard]] bool bold() const { return style.find("bold") != std::string::npos; }
  [[nodiscard]] bool italic() const {
    return style.find("italic") != std::string::npos || style.find("oblique") != std::string::npos;
  }
};

Description parse_description(const std::string& text) {
  Description result;
  size_t end = text.find(':');
  result.family = trimmed(lower(text.substr(0, end)));
  while (end != std::string::npos) {
    const size_t begin = end + 1;
    end = text.find(':', begin);
    const std::string field = trimmed(lower(text.substr(begin, end - begin)));
    const size_t equals = field.find('=');
    const std::string key =
        equals == std::string::npos ? "style" : trimmed(field.substr(0, equals));
    if (key != "style") continue;
    if (!result.style.empty()) result.style += ' ';
    result.style += trimmed(equals == std::string::npos ? field : field.substr(equals + 1));
  }
  return result;
}

bool is_regular(const std::string& style) {
  return style.empty() || style == "regular" || style == "book" || style == "normal" ||
         style == "roman";
}

bool same_style(const std::string& wanted, const std::string& had) {
  return wanted == had || (is_regular(wanted) && is_regular(had));
}

/// The font files below a folder, sorted by path.
std::vector<std::string> font_files(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  using Iterator = std::filesystem::recursive_directory_iterator;
  for (Iterator i(folder, error), end; !error && i != end; i.increment(error)) {
    std::error_code ignored;
    if (is_font_path(i->path().string()) && i->is_regular_file(ignored)) {
      files.push_back(i->path().string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::optional<Font> find_in_folder(const std::string& folder, const Description& wanted) {
  std::optional<Font> any_style;
  for (const std::string& path : font_files(folder)) {
    const Result<std::string> bytes = read_regular_file(path);
    if (!bytes) continue;
    Result<Font> font = Font::parse(path, *bytes);
    if (!font || lower(font->family()) != wanted.family) continue;
    if (same_style(wanted.style, lower(font->style()))) return *std::move(font);
    if (!any_style) any_style = *std::move(font);
  }
  return any_style;
}

}  // namespace

bool is_font_path(const std::string& description) {
  if (description.size() < 5) return false;
  const std::string ending = lower(description.substr(description.size() - 4));
  return ending == ".ttf" || ending == ".otf" || ending == ".ttc";
}

Result<FontChoice> FontBook::find(const std::string& description) {
  if (const auto known = found_.find(description); known != found_.end()) return known->second;
  if (auto failure = text_failure()) return *std::move(failure);
  const Description wanted = parse_description(description);
  FontChoice choice{Font::shipped(wanted.bold(), wanted.italic()), ""};
  std::optional<Font> found;
  const bool shipped = wanted.family.empty() || wanted.family == kShippedFamily;
  if (shipped && (same_style(wanted.style, lower(choice.font.style())))) {
    found = choice.font;
  } else if (options_.system_fonts) {
    found = find_in_folder(options_.folder, wanted);
  }
  const bool exact = found && same_style(wanted.style, lower(found->style()));
  if (found) choice.font = *std::move(found);
  if (!exact) {
    const std::string missing = "there is no font " + csgrun::quoted(description);
    if (options_.strict) {
      return invalid_argument(missing + (options_.system_fonts
                                             ? " in " + options_.folder
                                             : "; name a font file, or allow --system-fonts"));
    }
    choice.note =
        missing + "; " + choice.font.family() + " " + choice.font.style() + " is used instead";
  }
  found_.emplace(description, choice);
  return choice;
}

}  // namespace csgrun
