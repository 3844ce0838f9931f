// What the targets of drawings do with their input: read it, and shape what it shows.
#pragma once

#include <cmath>
#include <string>

#include <csgrun/primitives/flat_file.h>
#include <csgrun/primitives/shape_operations.h>

#include "tests/fuzz/checks.h"
#include "tests/fuzz/evaluate_small.h"

namespace csgrun::fuzz {

/// What every shape promises.
inline void expect_shape(const Shape2D& shape) {
  for (const Shape2D::Loop& loop : shape.loops()) {
    expect(loop.size() >= 3, "an outline of fewer than three points");
    for (const glm::dvec2& p : loop)
      expect(std::isfinite(p.x) && std::isfinite(p.y), "a point is not finite");
  }
  expect(shape.empty() || shape.area() >= 0, "an area below zero");
}

inline void expect_shape(const Result<Shape2D>& shape) {
  if (shape) {
    expect_shape(*shape);
  } else {
    expect_users_fault(shape.error());
  }
}

inline int read_drawing(const std::string& name, const uint8_t* data, size_t size) {
  FlatFileOptions options;
  options.center = size % 2 == 1;
  options.as_openscad = size % 4 >= 2;
  const auto file = parse_flat(name, text_of(data, size), options);
  if (!file) {
    expect_users_fault(file.error());
    return 0;
  }
  const Shape2D& shape = file->shape;
  expect_shape(shape);
  constexpr size_t kManyPoints = 400;  // what follows is to stay quick
  size_t points = 0;
  for (const Shape2D::Loop& loop : shape.loops()) points += loop.size();
  if (points > kManyPoints) return 0;
  for (const double distance : {0.25, -0.25}) {
    for (const OffsetJoin join : {OffsetJoin::kRound, OffsetJoin::kMitre, OffsetJoin::kChamfer})
      expect_shape(offset_shape(shape, {distance, join, Facets{8, 12, 2}}));
  }
  expect_shape(hull_of_shapes({shape}));
  expect_shape(fill_shape(shape));
  if (points < 40) expect_shape(minkowski_of_shapes({shape, shape}));
  return 0;
}

}  // namespace csgrun::fuzz
