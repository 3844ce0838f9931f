// PLY: ASCII and binary of either byte order. Of the element "vertex" x, y and z are kept, of
// "face" and "tristrips" the list vertex_indices (or vertex_index), of vertices and faces red,
// green, blue and alpha; everything else is stepped over.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "primitives/base/text.h"
#include "primitives/files/byte_order.h"
#include "primitives/files/face_colours.h"
#include "primitives/files/formats.h"
#include "primitives/files/text_scanner.h"

namespace csgrun {
namespace {

enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

std::optional<Type> type_of(std::string_view word) {
  if (word == "char" || word == "int8") return Type::kInt8;
  if (word == "uchar" || word == "uint8") return Type::kUint8;
  if (word == "short" || word == "int16") return Type::kInt16;
  if (word == "ushort" || word == "uint16") return Type::kUint16;
  if (word == "int" || word == "int32") return Type::kInt32;
  if (word == "uint" || word == "uint32") return Type::kUint32;
  if (word == "float" || word == "float32") return Type::kFloat;
  if (word == "double" || word == "float64") return Type::kDouble;
  return std::nullopt;
}

size_t size_of(Type type) {
  switch (type) {
    case Type::kInt8:
    case Type::kUint8:
      return 1;
    case Type::kInt16:
    case Type::kUint16:
      return 2;
    case Type::kDouble:
      return 8;
    default:
      return 4;
  }
}

bool is_integer(Type type) { return type != Type::kFloat && type != Type::kDouble; }

/// What a property means to us.
enum class Role { kNone, kX, kY, kZ, kCorners, kStrip, kRed, kGreen, kBlue, kAlpha };
constexpr size_t kRoles = 10;

bool is_colour(Role role) { return role >= Role::kRed; }

/// What stands for the full channel in a type.
double full_channel(Type type) {
  if (!is_integer(type)) return 1;
  return type == Type::kUint16 ? 65535 : 255;
}

struct Property {
  bool is_list = false;
  Type count_type = Type::kUint8, type = Type::kFloat;
  Role role = Role::kNone;
};

struct Element {
  std::string name;
  uint64_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { kAscii, kLittleEndian, kBigEndian };

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::vector<Element> elements;
  size_t data_begin = 0;  ///< byte offset
  size_t lines = 0;       ///< of the header
};

class HeaderReader {
 public:
  HeaderReader(const std::string& name, std::string_view bytes)
      : name_(name), bytes_(bytes), scanner_(bytes, '\0', line_end_of(bytes)) {}

  Result<Header> read() {
    if (scanner_.word() != "ply") return here("not a PLY file: it does not start with \"ply\"");
    bool has_format = false;
    while (scanner_.next_line()) {
      const std::string_view word = scanner_.word();
      std::optional<Error> error;
      if (word == "end_header") {
        if (!has_format) return here("the header has no \"format\"");
        scanner_.next_line();
        header_.data_begin = bytes_.size() - scanner_.remaining();
        header_.lines = scanner_.line() - 1;
        return std::move(header_);
      }
      if (word == "format") {
        error = read_format();
        has_format = true;
      } else if (word == "element") {
        error = read_element();
      } else if (word == "property") {
        error = read_property();
      } else if (!word.empty() && word != "comment" && word != "obj_info") {
        error = here("not a PLY header line: " + quoted(word));
      }
      if (error) return *error;
    }
    return here("the file ends within the header");
  }

 private:
  Error here(const std::string& what) { return malformed(name_, scanner_.place(), what); }

  /// That of the header: what follows may be binary.
  static char line_end_of(std::string_view bytes) {
    return TextScanner::line_end_of(bytes.substr(0, bytes.find("end_header")));
  }

  std::optional<Error> read_format() {
    const std::string_view word = scanner_.word();
    if (word == "ascii") {
      header_.encoding = Encoding::kAscii;
    } else if (word == "binary_little_endian") {
      header_.encoding = Encoding::kLittleEndian;
    } else if (word == "binary_big_endian") {
      header_.encoding = Encoding::kBigEndian;
    } else {
      return here("unknown format " + quoted(word));
    }
    return std::nullopt;
  }

  std::optional<Error> read_element() {
    Element& element = header_.elements.emplace_back();
    element.name = std::string(scanner_.word());
    const std::string_view word = scanner_.word();
    const auto count = parse_integer<uint64_t>(word);
    if (!count) return here("expected the number of elements, got " + quoted(word));
    element.count = *count;
    return std::nullopt;
  }

  std::optional<Error> read_property() {
    if (header_.elements.empty()) return here("a property before any element");
    Element& element = header_.elements.back();
    Property property;
    std::string_view word = scanner_.word();
    if (word == "list") {
      property.is_list = true;
      const std::string_view count_word = scanner_.word();
      const auto type = type_of(count_word);
      if (!type || !is_integer(*type)) {
        return here("expected an integer type, got " + quoted(count_word));
      }
      property.count_type = *type;
      word = scanner_.word();
    }
    const auto type = type_of(word);
    if (!type) return here("unknown type " + quoted(word));
    property.type = *type;
    const std::string_view property_name = scanner_.word();
    if (element.name == "vertex" && !property.is_list) {
      if (property_name == "x") property.role = Role::kX;
      if (property_name == "y") property.role = Role::kY;
      if (property_name == "z") property.role = Role::kZ;
    }
    if ((element.name == "vertex" || element.name == "face") && !property.is_list) {
      if (property_name == "red" || property_name == "diffuse_red") property.role = Role::kRed;
      if (property_name == "green" || property_name == "diffuse_green")
        property.role = Role::kGreen;
      if (property_name == "blue" || property_name == "diffuse_blue") property.role = Role::kBlue;
      if (property_name == "alpha") property.role = Role::kAlpha;
    }
    if ((element.name == "face" || element.name == "tristrips") && property.is_list &&
        (property_name == "vertex_indices" || property_name == "vertex_index")) {
      if (!is_integer(property.type)) return here("vertex indices must be integers");
      property.role = element.name == "face" ? Role::kCorners : Role::kStrip;
    }
    element.properties.push_back(property);
    return std::nullopt;
  }

  const std::string& name_;
  std::string_view bytes_;
  TextScanner scanner_;
  Header header_;
};

/// Numbers of an ASCII body.
class AsciiSource {
 public:
  AsciiSource(std::string_view bytes, const Header& header)
      : scanner_(bytes.substr(header.data_begin)), lines_(header.lines) {}
  std::optional<double> number(Type) { return parse_finite(scanner_.word_anywhere()); }
  bool skip(Type) { return !scanner_.word_anywhere().empty(); }
  [[nodiscard]] static uint64_t least_size(Type) { return 2; }  // a digit and a blank
  // The last number has no blank after it.
  [[nodiscard]] uint64_t remaining() const { return scanner_.remaining() + 1; }
  [[nodiscard]] std::string place() const {
    return "line " + std::to_string(lines_ + scanner_.line());
  }
  /// What is left over, for a note; empty if nothing is.
  std::string rest() {
    const std::string_view word = scanner_.word_anywhere();
    return word.empty() ? ""
                        : "data after the last element (" + place() + ": " + quoted(word) + ")";
  }

 private:
  TextScanner scanner_;
  size_t lines_;
};

/// Numbers of a binary body.
class BinarySource {
 public:
  BinarySource(std::string_view bytes, const Header& header)
      : bytes_(bytes), at_(header.data_begin), big_(header.encoding == Encoding::kBigEndian) {}

  std::optional<double> number(Type type) {
    const size_t size = size_of(type);
    if (bytes_.size() - at_ < size) return std::nullopt;
    const double value = read(type);
    if (!std::isfinite(value)) return std::nullopt;
    at_ += size;
    return value;
  }
  /// Steps over a number that is not used, and may be anything.
  bool skip(Type type) {
    if (bytes_.size() - at_ < size_of(type)) return false;
    at_ += size_of(type);
    return true;
  }
  [[nodiscard]] static uint64_t least_size(Type type) { return size_of(type); }
  [[nodiscard]] uint64_t remaining() const { return bytes_.size() - at_; }
  [[nodiscard]] std::string place() const { return "byte " + std::to_string(at_); }
  [[nodiscard]] std::string rest() const {
    if (remaining() == 0) return {};
    return std::to_string(remaining()) + (remaining() == 1 ? " byte" : " bytes") +
           " after the last element";
  }

 private:
  [[nodiscard]] double read(Type type) const {
    switch (type) {
      case Type::kInt8:
        return static_cast<int8_t>(read_unsigned<1>(bytes_, at_, big_));
      case Type::kUint8:
        return static_cast<uint8_t>(read_unsigned<1>(bytes_, at_, big_));
      case Type::kInt16:
        return static_cast<int16_t>(read_unsigned<2>(bytes_, at_, big_));
      case Type::kUint16:
        return static_cast<uint16_t>(read_unsigned<2>(bytes_, at_, big_));
      case Type::kInt32:
        return static_cast<int32_t>(read_unsigned<4>(bytes_, at_, big_));
      case Type::kUint32:
        return static_cast<uint32_t>(read_unsigned<4>(bytes_, at_, big_));
      case Type::kFloat:
        return read_float(bytes_, at_, big_);
      default:
        return read_double(bytes_, at_, big_);
    }
  }

  std::string_view bytes_;
  size_t at_;
  bool big_;
};

template <class Source>
class BodyReader {
 public:
  BodyReader(const std::string& name, const Header& header, Source source)
      : name_(name), header_(header), source_(std::move(source)) {}

  Result<PolygonMesh> read(std::vector<std::string>* notes) {
    if (auto error = check_roles()) return *error;
    for (const Element& element : header_.elements) {
      if (element.properties.empty()) continue;
      uint64_t least = 0;
      for (const Property& p : element.properties) {
        least += Source::least_size(p.is_list ? p.count_type : p.type);
      }
      const auto place = [&] { return source_.place(); };
      if (auto error = check_count(name_, place, "elements \"" + element.name + "\"", element.count,
                                   least, source_.remaining())) {
        return *error;
      }
      for (uint64_t i = 0; i < element.count; ++i) {
        if (auto error = read_element(element, i)) return *error;
      }
    }
    for (const uint32_t index : mesh_.corners) {
      if (index < mesh_.points.size()) continue;
      return malformed(name_, "",
                       "vertex index " + std::to_string(index) + " is out of range, there are " +
                           std::to_string(mesh_.points.size()) + " points");
    }
    const std::string rest = source_.rest();
    if (!rest.empty() && notes != nullptr) notes->push_back(rest + " passed over");
    note_small_faces(small_faces_, notes);
    colours_.apply(mesh_, notes);
    return std::move(mesh_);
  }

 private:
  Error here(const std::string& what) { return malformed(name_, source_.place(), what); }

  std::optional<Error> check_roles() {
    bool seen[kRoles] = {};
    for (const Element& element : header_.elements) {
      for (const Property& p : element.properties) seen[static_cast<int>(p.role)] = true;
    }
    for (const Role role : {Role::kX, Role::kY, Role::kZ}) {
      if (!seen[static_cast<int>(role)]) {
        return malformed(name_, "", "the element \"vertex\" has no x, y and z");
      }
    }
    if (!seen[static_cast<int>(Role::kCorners)] && !seen[static_cast<int>(Role::kStrip)]) {
      const bool has_faces = std::any_of(header_.elements.begin(), header_.elements.end(),
                                         [](const Element& e) { return e.name == "face"; });
      return malformed(name_, "",
                       has_faces ? "the element \"face\" has no list \"vertex_indices\""
                                 : "has no faces: there are points only");
    }
    return std::nullopt;
  }

  std::optional<Error> read_element(const Element& element, uint64_t i) {
    glm::dvec3 point(0);
    Rgba colour{0, 0, 0, 1};
    bool is_point = false;
    const size_t faces_before = mesh_.face_count();
    int channels = 0;
    for (const Property& property : element.properties) {
      if (property.is_list) {
        if (auto error = read_list(element, i, property)) return error;
        continue;
      }
      if (property.role == Role::kNone) {
        if (!source_.skip(property.type)) return bad_number(element, i);
        continue;
      }
      const std::optional<double> value = source_.number(property.type);
      if (!value) return bad_number(element, i);
      if (is_colour(property.role)) {
        const int channel = static_cast<int>(property.role) - static_cast<int>(Role::kRed);
        channels |= 1 << channel;
        colour[static_cast<size_t>(channel)] =
            static_cast<float>(std::clamp(*value / full_channel(property.type), 0.0, 1.0));
        continue;
      }
      is_point = true;
      point[static_cast<int>(property.role) - static_cast<int>(Role::kX)] = *value;
    }
    constexpr int kRedGreenBlue = 7;
    const bool has_colour = (channels & kRedGreenBlue) == kRedGreenBlue;
    if (is_point) {
      mesh_.points.push_back(point);
      if (has_colour) colours_.set_vertex(mesh_.points.size() - 1, colour);
    } else if (has_colour && mesh_.face_count() > faces_before) {
      colours_.set_face(mesh_.face_count() - 1, colour);
    }
    return std::nullopt;
  }

  std::optional<Error> read_list(const Element& element, uint64_t i, const Property& property) {
    const std::optional<double> length = source_.number(property.count_type);
    if (!length) return bad_number(element, i);
    constexpr double kMostEntries = 0x1p53;  // larger ones are no exact numbers
    if (!(*length >= 0 && *length <= kMostEntries) || *length != std::floor(*length)) {
      return here("a list has the length " + number_text(*length));
    }
    const auto count = static_cast<uint64_t>(*length);
    const auto place = [&] { return source_.place(); };
    if (auto error = check_count(name_, place, "entries of a list", count,
                                 Source::least_size(property.type), source_.remaining())) {
      return error;
    }
    loop_.clear();
    for (uint64_t k = 0; k < count; ++k) {
      if (property.role == Role::kNone) {
        if (!source_.skip(property.type)) return bad_number(element, i);
        continue;
      }
      const std::optional<double> value = source_.number(property.type);
      if (!value) return bad_number(element, i);
      if (property.role == Role::kStrip && *value == -1) {  // another strip begins
        add_strip();
        continue;
      }
      if (!(*value >= 0 && *value < 4294967295.0) || *value != std::floor(*value)) {
        return here("bad vertex index in " + element.name + " " + std::to_string(i));
      }
      loop_.push_back(static_cast<uint32_t>(*value));
    }
    if (property.role == Role::kStrip) add_strip();
    if (property.role != Role::kCorners) return std::nullopt;
    if (loop_.size() < 3) {
      small_faces_.add("face " + std::to_string(i));
    } else {
      mesh_.add_face(loop_);
    }
    return std::nullopt;
  }

  /// The triangles of a strip, every other one turned; those that repeat a corner only lead on.
  void add_strip() {
    for (size_t k = 0; k + 2 < loop_.size(); ++k) {
      const uint32_t a = loop_[k], b = loop_[k + 1 + k % 2], c = loop_[k + 2 - k % 2];
      if (a != b && b != c && c != a) mesh_.add_face(std::array<uint32_t, 3>{a, b, c});
    }
    loop_.clear();
  }

  Error bad_number(const Element& element, uint64_t i) {
    return here(element.name + " " + std::to_string(i) + ": " +
                (source_.remaining() <= 1 ? "the file ends here" : "not a finite number"));
  }

  const std::string& name_;
  const Header& header_;
  Source source_;
  PolygonMesh mesh_;
  FaceColours colours_;
  std::vector<uint32_t> loop_;
  PassedOver small_faces_;
};

}  // namespace

Result<PolygonMesh> parse_ply(const std::string& name, std::string_view bytes,
                              std::vector<std::string>* notes) {
  const Result<Header> header = HeaderReader(name, bytes).read();
  if (!header) return header.error();
  if (header->encoding == Encoding::kAscii) {
    return BodyReader(name, *header, AsciiSource(bytes, *header)).read(notes);
  }
  return BodyReader(name, *header, BinarySource(bytes, *header)).read(notes);
}

}  // namespace csgrun
