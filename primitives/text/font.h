// A face with its HarfBuzz objects, in its own units.
#pragma once

#include <memory>
#include <string>

#include <csgrun/primitives/text.h>

#include "primitives/text/harfbuzz.h"

namespace csgrun {

struct HarfbuzzDeleter {
  void operator()(hb_blob_t* p) const { hb().blob_destroy(p); }
  void operator()(hb_face_t* p) const { hb().face_destroy(p); }
  void operator()(hb_font_t* p) const { hb().font_destroy(p); }
  void operator()(hb_buffer_t* p) const { hb().buffer_destroy(p); }
  void operator()(hb_draw_funcs_t* p) const { hb().draw_funcs_destroy(p); }
};
template <class T>
using HarfbuzzPtr = std::unique_ptr<T, HarfbuzzDeleter>;

/// OpenSCAD's font library sets type in whole numbers of these units, of which a size has 10^5: an
/// em of size * 100 / 72 has 138889, a pixel 64.
constexpr int kTypeUnitsOfSize = 100000, kTypeUnitsOfEm = 138889, kTypeUnitsOfPixel = 64;

struct Font::Data {
  std::string bytes;  ///< empty for a shipped face, whose bytes are the program's
  HarfbuzzPtr<hb_blob_t> blob;
  HarfbuzzPtr<hb_face_t> face;
  HarfbuzzPtr<hb_font_t> font;  ///< its scale is the em in units, so that all numbers are whole
  HarfbuzzPtr<hb_font_t> in_type_units;  ///< the same, with kTypeUnitsOfEm for an em
  int outline_em = kTypeUnitsOfEm;       ///< of an em, in type units, for outlines
  std::string family, style;
  double units_per_em = 1000;
};

/// What the file's name table says; empty if nothing.
std::string face_name(hb_face_t* face, hb_ot_name_id_t first, hb_ot_name_id_t second);

}  // namespace csgrun
