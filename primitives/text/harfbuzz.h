// HarfBuzz, loaded when the first text is asked for.
//
// Its library brings six others (glib and freetype among them), which would take a third of the
// time of a small script: so the program is not linked with it. Its headers give the types and the
// signatures, and the calls go through hb().
#pragma once

#include <hb-ot.h>
#include <hb.h>

namespace csgrun {

#if HB_VERSION_ATLEAST(7, 0, 0)
#define CSGRUN_HARFBUZZ_DRAW_CALL(CALL) CALL(font_draw_glyph)
#else
#define CSGRUN_HARFBUZZ_DRAW_CALL(CALL) CALL(font_get_glyph_shape)
#endif

/// The calls that text needs, each for CALL(its name without the prefix).
#define CSGRUN_HARFBUZZ_CALLS(CALL)         \
  CALL(blob_create)                         \
  CALL(blob_destroy)                        \
  CALL(blob_get_data)                       \
  CALL(blob_get_length)                     \
  CALL(buffer_add_utf8)                     \
  CALL(buffer_create)                       \
  CALL(buffer_destroy)                      \
  CALL(buffer_get_direction)                \
  CALL(buffer_get_glyph_infos)              \
  CALL(buffer_get_glyph_positions)          \
  CALL(buffer_get_length)                   \
  CALL(buffer_guess_segment_properties)     \
  CALL(buffer_set_direction)                \
  CALL(buffer_set_language)                 \
  CALL(buffer_set_replacement_codepoint)    \
  CALL(buffer_set_script)                   \
  CALL(direction_from_string)               \
  CALL(draw_funcs_create)                   \
  CALL(draw_funcs_destroy)                  \
  CALL(draw_funcs_make_immutable)           \
  CALL(draw_funcs_set_cubic_to_func)        \
  CALL(draw_funcs_set_line_to_func)         \
  CALL(draw_funcs_set_move_to_func)         \
  CALL(draw_funcs_set_quadratic_to_func)    \
  CALL(face_count)                          \
  CALL(face_create)                         \
  CALL(face_destroy)                        \
  CALL(face_get_glyph_count)                \
  CALL(face_get_upem)                       \
  CALL(face_reference_table)                \
  CALL(feature_from_string)                 \
  CALL(font_create)                         \
  CALL(font_create_sub_font)                \
  CALL(font_destroy)                        \
  CALL(font_funcs_create)                   \
  CALL(font_funcs_make_immutable)           \
  CALL(font_funcs_set_glyph_v_advance_func) \
  CALL(font_funcs_set_glyph_v_origin_func)  \
  CALL(font_get_glyph_extents)              \
  CALL(font_get_glyph_h_advance)            \
  CALL(font_get_h_extents)                  \
  CALL(font_get_scale)                      \
  CALL(font_make_immutable)                 \
  CALL(font_set_funcs)                      \
  CALL(font_set_scale)                      \
  CALL(language_from_string)                \
  CALL(ot_name_get_utf8)                    \
  CALL(script_from_string)                  \
  CALL(shape)                               \
  CSGRUN_HARFBUZZ_DRAW_CALL(CALL)

/// HarfBuzz's functions, without their prefix.
struct HarfBuzz {
#define CSGRUN_CALL(name) decltype(&::hb_##name) name = nullptr;
  CSGRUN_HARFBUZZ_CALLS(CSGRUN_CALL)
#undef CSGRUN_CALL
};

/// HarfBuzz, loaded by the first call; from any thread. Throws std::runtime_error if the library is
/// not there or lacks a function.
const HarfBuzz& hb();

}  // namespace csgrun
