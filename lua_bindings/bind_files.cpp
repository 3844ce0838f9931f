// read_text, read_json, read_csv, load_csg: files below the model's folder, as values.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <csgrun/primitives/csg_file.h>

#include "lua_bindings/api.h"
#include "lua_bindings/call_site.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/json_fault.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

using T = ArgumentType;
using Json = nlohmann::json;

constexpr int kDeepest = 200;  // tables in tables; a file beyond it is made to break readers
constexpr const char* kTooDeep = "tables are nested deeper than 200 times";
constexpr size_t kMostBytes = size_t{256} << 20;

constexpr const char* kFileDoc =
    "relative to the file that calls, or else to the folders of -L and CSGRUN_PATH";

/// The file that option "file" names. Throws ScriptError.
Files::Opened open_file(lua_State* L, const Arguments& arguments, const FunctionSpec& spec) {
  const std::string path = arguments.string("file", "");
  if (path.empty()) fail_in(spec, "needs the name of a file");
  Files::Opened file;
  try {
    file = session_of(L).files().open(calling_file(L), path);
  } catch (const ScriptError& error) {
    fail_in(spec, error.what());
  }
  if (file.bytes.size() > kMostBytes) fail_in(spec, "'" + path + "' is larger than 256 MB");
  return file;
}

constexpr Option kReadTextOptions[] = {{"file", T::kString, "", kFileDoc, true}};
constexpr FunctionSpec kReadText{"read_text", "The bytes of a file as a string.", kReadTextOptions,
                                 false, "read_text(\"notes.txt\")"};

int read_text(lua_State* L) {
  const Arguments arguments(L, kReadText, 1);
  const Files::Opened file = open_file(L, arguments, kReadText);
  lua_pushlstring(L, file.bytes.data(), file.bytes.size());
  return 1;
}

constexpr FunctionSpec kReadJson{
    "read_json",
    "What a JSON file holds, as tables, lists, strings, numbers, true and false; null is nil.",
    kReadTextOptions, false, "read_json(\"sizes.json\").width"};

void push_json(lua_State* L, const Json& value, const std::string& path, int depth) {
  if (depth > kDeepest) fail_in(kReadJson, kTooDeep);
  luaL_checkstack(L, 8, "read_json");
  switch (value.type()) {
    case Json::value_t::boolean:
      lua_pushboolean(L, value.get<bool>() ? 1 : 0);
      return;
    case Json::value_t::number_integer:
      lua_pushinteger(L, value.get<lua_Integer>());
      return;
    case Json::value_t::number_unsigned:
      if (value.get<uint64_t>() <= static_cast<uint64_t>(LUA_MAXINTEGER)) {
        lua_pushinteger(L, static_cast<lua_Integer>(value.get<uint64_t>()));
      } else {
        lua_pushnumber(L, value.get<double>());
      }
      return;
    case Json::value_t::number_float:
      lua_pushnumber(L, value.get<double>());
      return;
    case Json::value_t::string: {
      const auto& text = value.get_ref<const std::string&>();
      lua_pushlstring(L, text.data(), text.size());
      return;
    }
    case Json::value_t::array:
      lua_newtable(L);
      for (size_t i = 0; i < value.size(); ++i) {
        if (value[i].is_null())
          fail_in(kReadJson, fmt::format("'{}': entry {} of a list is null, which lists of Lua "
                                         "cannot have",
                                         path, i + 1));
        push_json(L, value[i], path, depth + 1);
        lua_rawseti(L, -2, static_cast<lua_Integer>(i + 1));
      }
      return;
    case Json::value_t::object:
      lua_newtable(L);
      for (const auto& [key, entry] : value.items()) {
        lua_pushlstring(L, key.data(), key.size());
        push_json(L, entry, path, depth + 1);
        lua_rawset(L, -3);
      }
      return;
    default:
      lua_pushnil(L);
  }
}

int read_json(lua_State* L) {
  const Arguments arguments(L, kReadJson, 1);
  const Files::Opened file = open_file(L, arguments, kReadJson);
  Json json;
  try {
    // Depth is told while it is read: what nests a million times need not be built first.
    json = Json::parse(file.bytes, [](int depth, Json::parse_event_t, const Json&) {
      if (depth > kDeepest) fail_in(kReadJson, kTooDeep);
      return true;
    });
  } catch (const Json::parse_error& error) {
    fail_in(kReadJson, file.display + ":" + json_fault(file.bytes, error));
  } catch (const Json::out_of_range&) {
    fail_in(kReadJson, file.display + ": a number is beyond the range of doubles");
  }
  push_json(L, json, file.display, 0);
  return 1;
}

constexpr Option kReadCsvOptions[] = {
    {"file", T::kString, "", kFileDoc, true},
    {"header", T::kBoolean, "false",
     "the first line has names: each row is a table by these, instead of a list", false},
    {"separator", T::kString, "\",\"", "one character between the fields", false},
    {"numbers", T::kBoolean, "true", "fields that are numbers become numbers", false},
};
constexpr FunctionSpec kReadCsv{
    "read_csv",
    "The rows of a table in text, as lists of numbers and strings. Fields may stand in \"quotes\".",
    kReadCsvOptions, false, "read_csv(\"points.csv\", {header = true})[1].x"};

/// RFC 4180, with any end of line.
class CsvReader {
 public:
  CsvReader(const std::string& text, char separator) : text_(text), separator_(separator) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  }
  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  [[nodiscard]] int line() const { return line_; }
  [[nodiscard]] bool was_quoted(size_t field) const { return quoted_[field]; }

  /// The fields of the next line. Throws ScriptError.
  std::vector<std::string> row(const std::string& name) {
    std::vector<std::string> fields;
    quoted_.clear();
    while (true) {
      std::string field;
      const bool quoted = at_ < text_.size() && text_[at_] == '"';
      if (quoted) {
        read_quoted(name, field);
      } else {
        while (!is_end_of_field()) field += text_[at_++];
      }
      fields.push_back(std::move(field));
      quoted_.push_back(quoted);
      if (!is_end_of_field())
        fail_in(kReadCsv, fmt::format("{}:{}: text after a closing quote", name, line_));
      if (at_ < text_.size() && text_[at_] == separator_) {
        ++at_;
        continue;
      }
      if (at_ < text_.size() && text_[at_] == '\r') ++at_;
      if (at_ < text_.size() && text_[at_] == '\n') ++at_;
      ++line_;
      return fields;
    }
  }

 private:
  [[nodiscard]] bool is_end_of_field() const {
    return at_ >= text_.size() || text_[at_] == separator_ || text_[at_] == '\n' ||
           text_[at_] == '\r';
  }

  void read_quoted(const std::string& name, std::string& field) {
    const int start = line_;
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '"') {
        ++at_;
        if (at_ >= text_.size() || text_[at_] != '"') return;
      }
      if (text_[at_] == '\n') ++line_;
      field += text_[at_];
    }
    fail_in(kReadCsv, fmt::format("{}:{}: a quote is not closed", name, start));
  }

  const std::string& text_;
  char separator_;
  size_t at_ = 0;
  int line_ = 1;
  std::vector<bool> quoted_;
};

/// `place`: the file and line, for messages.
void push_field(lua_State* L, const std::string& field, bool as_number, const std::string& place) {
  // Only decimals: "0x10" and "nan" are words.
  const bool looks_like_number =
      as_number && !field.empty() &&
      field.find_first_not_of("0123456789+-.eE \t") == std::string::npos &&
      field.find_first_of("0123456789") != std::string::npos;
  if (looks_like_number && lua_stringtonumber(L, field.c_str()) == field.size() + 1) {
    if (!std::isfinite(lua_tonumber(L, -1)))
      fail_in(kReadCsv, place + ": " + field + " is beyond the range of doubles");
    return;
  }
  lua_pushlstring(L, field.data(), field.size());
}

int read_csv(lua_State* L) {
  const Arguments arguments(L, kReadCsv, 1);
  const std::string separator = arguments.string("separator", ",");
  if (separator.size() != 1 || separator == "\"" || separator == "\n" || separator == "\r")
    fail_in(kReadCsv, "option 'separator' must be one character");
  const bool as_numbers = arguments.boolean("numbers", true);
  const Files::Opened file = open_file(L, arguments, kReadCsv);
  CsvReader reader(file.bytes, separator[0]);
  std::vector<std::string> names;
  if (arguments.boolean("header", false)) {
    if (reader.at_end()) fail_in(kReadCsv, file.display + ": there is no line with names");
    names = reader.row(file.display);
    for (size_t i = 0; i < names.size(); ++i) {
      if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
          names.begin() + static_cast<std::ptrdiff_t>(i))
        fail_in(kReadCsv,
                fmt::format("{}:1: two columns have the name '{}'", file.display, names[i]));
    }
  }
  lua_newtable(L);
  lua_Integer count = 0;
  while (!reader.at_end()) {
    const int line = reader.line();
    const std::vector<std::string> fields = reader.row(file.display);
    if (fields.size() == 1 && fields[0].empty() && !reader.was_quoted(0)) continue;  // empty line
    if (!names.empty() && fields.size() != names.size()) {
      fail_in(kReadCsv, fmt::format("{}:{}: {} fields under {} names", file.display, line,
                                    fields.size(), names.size()));
    }
    const std::string place = fmt::format("{}:{}", file.display, line);
    lua_createtable(L, static_cast<int>(fields.size()), 0);
    for (size_t i = 0; i < fields.size(); ++i) {
      if (names.empty()) {
        push_field(L, fields[i], as_numbers && !reader.was_quoted(i), place);
        lua_rawseti(L, -2, static_cast<lua_Integer>(i + 1));
      } else {
        lua_pushlstring(L, names[i].data(), names[i].size());
        push_field(L, fields[i], as_numbers && !reader.was_quoted(i), place);
        lua_rawset(L, -3);
      }
    }
    lua_rawseti(L, -2, ++count);
  }
  return 1;
}

constexpr FunctionSpec kLoadCsg{
    "load_csg", "What OpenSCAD's .csg file describes: a solid, or a shape when all of it is flat.",
    kReadTextOptions, false, "load_csg(\"tree.csg\"):translate(0, 0, 10)"};

int load_csg(lua_State* L) {
  const Arguments arguments(L, kLoadCsg, 1);
  Session& session = session_of(L);
  const Files::Opened file = open_file(L, arguments, kLoadCsg);
  const SourceRef where = session.source_ref(file.display, 1);
  const std::string folder = folder_of(file.display);
  CsgEnvironment environment;
  environment.evaluator = &session.evaluator();
  environment.fonts = &session.fonts();
  environment.file = where.file;
  environment.read = [&](const std::string& path) -> Result<std::string> {
    try {
      return session.files().open(file.display, path).bytes;
    } catch (const ScriptError& error) {
      return Error{ErrorCode::kMalformedFile, error.what(), {}};
    }
  };
  bool evaluation_failed = false;
  environment.evaluation_failed = &evaluation_failed;
  const auto model = [&] {
    const EvaluationScope scope(session.budget());
    return parse_csg(*where.file, file.bytes, environment);
  }();
  if (!model) {
    const std::string place = session.place_text(model.error().where);
    Error error = model.error();
    error.message = (place.empty() ? file.display : place) + ": " + error.message;
    if (!evaluation_failed) fail_in(kLoadCsg, error.message);
    error.message = "load_csg: " + error.message;
    error.where = {};
    session.fail_evaluation(error);
  }
  for (const std::string& warning : model->warnings) session.warn(L, "load_csg: " + warning);
  if (model->is_2d) {
    push_shape(L, model->shape, model->appearance);
  } else {
    push_solid(L, model->solid);
  }
  return 1;
}

constexpr Binding kFilesBindings[] = {
    {&kReadText, guarded<read_text>, nullptr, nullptr},
    {&kReadJson, guarded<read_json>, nullptr, nullptr},
    {&kReadCsv, guarded<read_csv>, nullptr, nullptr},
    {&kLoadCsg, guarded<load_csg>, nullptr, nullptr},
};

}  // namespace

std::span<const Binding> file_bindings() { return kFilesBindings; }

}  // namespace csgrun
