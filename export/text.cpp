#include "export/text.h"

namespace csgrun {
namespace {

/// The length of the valid UTF-8 sequence at the start of `text`, 0 when there is none. Overlong
/// forms, surrogates and code points above U+10FFFF are not valid (Unicode, table 3-7).
size_t sequence_length(std::string_view text) {
  const auto byte = [text](size_t i) { return static_cast<unsigned char>(text[i]); };
  const auto continues = [&](size_t i, unsigned low, unsigned high) {
    return i < text.size() && byte(i) >= low && byte(i) <= high;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return continues(1, 0x80, 0xBF) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    const unsigned low = first == 0xE0 ? 0xA0 : 0x80, high = first == 0xED ? 0x9F : 0xBF;
    return continues(1, low, high) && continues(2, 0x80, 0xBF) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    const unsigned low = first == 0xF0 ? 0x90 : 0x80, high = first == 0xF4 ? 0x8F : 0xBF;
    return continues(1, low, high) && continues(2, 0x80, 0xBF) && continues(3, 0x80, 0xBF) ? 4 : 0;
  }
  return 0;
}

std::string with_controls_replaced(std::string_view text, char replacement, bool spaces_too) {
  std::string result(text);
  for (char& c : result) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F || (spaces_too && c == ' ')) c = replacement;
  }
  return result;
}

}  // namespace

std::string valid_utf8(std::string_view name) {
  std::string result;
  while (!name.empty()) {
    const size_t length = sequence_length(name);
    if (length == 0) {
      result += "\xEF\xBF\xBD";
      name.remove_prefix(1);
    } else {
      result += name.substr(0, length);
      name.remove_prefix(length);
    }
  }
  return result;
}

std::string one_word(std::string_view name) { return with_controls_replaced(name, '_', true); }

std::string one_line(std::string_view text) { return with_controls_replaced(text, ' ', false); }

std::string xml_text(std::string_view text) {
  std::string result;
  const std::string line = one_line(valid_utf8(text));
  for (std::string_view rest = line; !rest.empty();) {
    const size_t length = sequence_length(rest);
    const std::string_view c = rest.substr(0, length);
    rest.remove_prefix(length);
    if (c == "&") {
      result += "&amp;";
    } else if (c == "<") {
      result += "&lt;";
    } else if (c == ">") {
      result += "&gt;";
    } else if (c == "\"") {
      result += "&quot;";
    } else if (c == "\xEF\xBF\xBE" || c == "\xEF\xBF\xBF") {  // U+FFFE, U+FFFF
      result += "\xEF\xBF\xBD";
    } else {
      result += c;
    }
  }
  return result;
}

std::string distinct(const std::string& name, std::set<std::string>& taken) {
  std::string unique = name;
  for (int i = 2; !taken.insert(unique).second; ++i) unique = name + "_" + std::to_string(i);
  return unique;
}

std::string source_text(const Solid& solid, uint32_t source) {
  if (source >= solid.sources.size()) return {};
  const Solid::Source& s = solid.sources[source];
  return one_line(s.kind.empty() || s.where.empty() ? s.kind + s.where : s.kind + ", " + s.where);
}

}  // namespace csgrun
