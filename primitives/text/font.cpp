#include "primitives/text/font.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>

#include "primitives/files/formats.h"
#include "primitives/text/shipped_fonts.h"

namespace csgrun {
namespace {

/// A word of 16 bits in a table of the face; nothing where the table is not, or is too short.
std::optional<uint16_t> word_of(hb_face_t* face, hb_tag_t tag, unsigned at) {
  const HarfbuzzPtr<hb_blob_t> table(hb().face_reference_table(face, tag));
  unsigned length = 0;
  const char* bytes = hb().blob_get_data(table.get(), &length);
  if (at + 2 > length) return std::nullopt;
  return static_cast<uint16_t>(static_cast<unsigned char>(bytes[at]) << 8 |
                               static_cast<unsigned char>(bytes[at + 1]));
}

bool has_table(hb_face_t* face, hb_tag_t tag) {
  const HarfbuzzPtr<hb_blob_t> table(hb().face_reference_table(face, tag));
  return hb().blob_get_length(table.get()) > 0;
}

/// A column of a font that says nothing about columns, as OpenSCAD's font library sets it: cells as
/// high as the typographic ascent and descent, with each glyph's ink in the middle of its own.
struct Columns {
  hb_font_t* units = nullptr;  ///< of the same face, scaled to its units
  int cell = 0, em = 1;        ///< in its units

  [[nodiscard]] hb_position_t scaled(hb_font_t* font, int units_up) const {
    int x_scale = 0, y_scale = 0;
    hb().font_get_scale(font, &x_scale, &y_scale);
    return static_cast<hb_position_t>(std::llround(double(units_up) * y_scale / em));
  }
};

hb_font_funcs_t* make_column_functions() {
  hb_font_funcs_t* f = hb().font_funcs_create();
  hb().font_funcs_set_glyph_v_advance_func(
      f,
      [](hb_font_t* font, void* data, hb_codepoint_t, void*) {
        const auto* columns = static_cast<const Columns*>(data);
        return -columns->scaled(font, columns->cell);
      },
      nullptr, nullptr);
  hb().font_funcs_set_glyph_v_origin_func(
      f,
      [](hb_font_t* font, void* data, hb_codepoint_t glyph, hb_position_t* x, hb_position_t* y,
         void*) -> hb_bool_t {
        const auto* columns = static_cast<const Columns*>(data);
        hb_glyph_extents_t box{};
        if (!hb().font_get_glyph_extents(columns->units, glyph, &box)) return 0;
        *x = hb().font_get_glyph_h_advance(font, glyph) / 2;
        *y = columns->scaled(font, box.y_bearing) +
             columns->scaled(font, (columns->cell + box.height) / 2);  // its height is negative
        return 1;
      },
      nullptr, nullptr);
  hb().font_funcs_make_immutable(f);
  return f;
}

/// The face with so many units to an em.
HarfbuzzPtr<hb_font_t> font_of(hb_face_t* face, int scale) {
  HarfbuzzPtr<hb_font_t> font(hb().font_create(face));
  hb().font_set_scale(font.get(), scale, scale);
  constexpr hb_tag_t kOs2 = HB_TAG('O', 'S', '/', '2');
  constexpr unsigned kAscent = 68, kDescent = 70;
  const auto ascent = word_of(face, kOs2, kAscent), descent = word_of(face, kOs2, kDescent);
  if (!descent || has_table(face, HB_TAG('v', 'm', 't', 'x'))) return font;
  static hb_font_funcs_t* const functions = make_column_functions();
  const int em = static_cast<int>(hb().face_get_upem(face));
  hb_font_t* units = hb().font_create(face);
  hb().font_set_scale(units, em, em);
  const int cell = static_cast<int16_t>(*ascent) - static_cast<int16_t>(*descent);
  HarfbuzzPtr<hb_font_t> with_columns(hb().font_create_sub_font(font.get()));
  hb().font_set_funcs(with_columns.get(), functions, new Columns{units, std::abs(cell), em},
                      [](void* data) {
                        auto* columns = static_cast<Columns*>(data);
                        hb().font_destroy(columns->units);
                        delete columns;
                      });
  return with_columns;
}

/// Data over bytes that stay where they are; null when they are no font.
std::shared_ptr<Font::Data> face_over(std::shared_ptr<Font::Data> data, std::string_view bytes) {
  if (bytes.size() > UINT32_MAX) return nullptr;
  data->blob.reset(hb().blob_create(bytes.data(), static_cast<unsigned>(bytes.size()),
                                    HB_MEMORY_MODE_READONLY, nullptr, nullptr));
  if (hb().face_count(data->blob.get()) == 0) return nullptr;
  data->face.reset(hb().face_create(data->blob.get(), 0));
  if (hb().face_get_glyph_count(data->face.get()) == 0) return nullptr;
  const unsigned em = hb().face_get_upem(data->face.get());
  data->units_per_em = em;
  data->font = font_of(data->face.get(), static_cast<int>(em));
  data->in_type_units = font_of(data->face.get(), kTypeUnitsOfEm);
  constexpr hb_tag_t kHead = HB_TAG('h', 'e', 'a', 'd');
  constexpr unsigned kFlags = 16, kWholePixels = 1 << 3;
  const bool whole_pixels =
      (word_of(data->face.get(), kHead, kFlags).value_or(0) & kWholePixels) != 0;
  if (whole_pixels && has_table(data->face.get(), HB_TAG('g', 'l', 'y', 'f')))
    data->outline_em =
        (kTypeUnitsOfEm + kTypeUnitsOfPixel / 2) / kTypeUnitsOfPixel * kTypeUnitsOfPixel;
  data->family =
      face_name(data->face.get(), HB_OT_NAME_ID_TYPOGRAPHIC_FAMILY, HB_OT_NAME_ID_FONT_FAMILY);
  data->style = face_name(data->face.get(), HB_OT_NAME_ID_TYPOGRAPHIC_SUBFAMILY,
                          HB_OT_NAME_ID_FONT_SUBFAMILY);
  hb().font_make_immutable(data->font.get());
  hb().font_make_immutable(data->in_type_units.get());
  return data;
}

}  // namespace

std::string face_name(hb_face_t* face, hb_ot_name_id_t first, hb_ot_name_id_t second) {
  for (const hb_ot_name_id_t id : {first, second}) {
    std::array<char, 256> text{};
    auto size = static_cast<unsigned>(text.size());
    hb().ot_name_get_utf8(face, id, hb().language_from_string("en", -1), &size, text.data());
    if (size > 0) return {text.data(), std::min<size_t>(size, text.size() - 1)};
  }
  return {};
}

Result<Font> Font::parse(const std::string& name, std::string_view bytes) {
  if (auto failure = text_failure()) return *std::move(failure);
  auto data = std::make_shared<Data>();
  data->bytes = std::string(bytes);
  std::shared_ptr<Data> face = face_over(data, data->bytes);
  if (!face) {
    return Error{ErrorCode::kMalformedFile,
                 name + ": this is no TrueType or OpenType font, or it is damaged",
                 {}};
  }
  return Font(std::move(face));
}

Font Font::shipped(bool bold, bool italic) {
  return Font(face_over(std::make_shared<Data>(), shipped_font(bold, italic)));
}

const std::string& Font::family() const { return data_->family; }
const std::string& Font::style() const { return data_->style; }

}  // namespace csgrun
