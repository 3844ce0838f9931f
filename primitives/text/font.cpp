#include "primitives/text/font.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "primitives/files/formats.h"
#include "primitives/text/shipped_fonts.h"

namespace csgrun {
namespace {

/// Data over bytes that stay where they are; null when they are no font.
std::shared_ptr<Font::Data> face_over(std::shared_ptr<Font::Data> data, std::string_view bytes) {
  if (bytes.size() > UINT32_MAX) return nullptr;
  data->blob.reset(hb_blob_create(bytes.data(), static_cast<unsigned>(bytes.size()),
                                  HB_MEMORY_MODE_READONLY, nullptr, nullptr));
  if (hb_face_count(data->blob.get()) == 0) return nullptr;
  data->face.reset(hb_face_create(data->blob.get(), 0));
  if (hb_face_get_glyph_count(data->face.get()) == 0) return nullptr;
  data->font.reset(hb_font_create(data->face.get()));
  const unsigned em = hb_face_get_upem(data->face.get());
  data->units_per_em = em;
  hb_font_set_scale(data->font.get(), static_cast<int>(em), static_cast<int>(em));
  data->family =
      face_name(data->face.get(), HB_OT_NAME_ID_TYPOGRAPHIC_FAMILY, HB_OT_NAME_ID_FONT_FAMILY);
  data->style = face_name(data->face.get(), HB_OT_NAME_ID_TYPOGRAPHIC_SUBFAMILY,
                          HB_OT_NAME_ID_FONT_SUBFAMILY);
  hb_font_make_immutable(data->font.get());
  return data;
}

}  // namespace

std::string face_name(hb_face_t* face, hb_ot_name_id_t first, hb_ot_name_id_t second) {
  for (const hb_ot_name_id_t id : {first, second}) {
    std::array<char, 256> text{};
    auto size = static_cast<unsigned>(text.size());
    hb_ot_name_get_utf8(face, id, hb_language_from_string("en", -1), &size, text.data());
    if (size > 0) return {text.data(), std::min<size_t>(size, text.size() - 1)};
  }
  return {};
}

Result<Font> Font::parse(const std::string& name, std::string_view bytes) {
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
