// Reading drawings in tests, and the areas that their curves should have.
#pragma once

#include <string>
#include <vector>

#include <csgrun/primitives/flat_file.h>

namespace csgrun::testing {

constexpr double kPi = 3.14159265358979323846;

double ngon(int n, double r);

/// Points of an arc of an n-gon of radius 1, from the X axis on.
std::vector<glm::dvec2> arc_points(int n, int first, int last);

/// The area of a polygon whose points go to the nearest of the places that are 1/1024 apart.
double area_on_grid(std::vector<glm::dvec2> points, double scale);

double ngon_on_grid(int n, double r);

FlatFileOptions with_fn(double fn);

/// An SVG of 100 by 100 mm where a user unit is one millimetre.
std::string page(const std::string& content);

FlatFile read(const std::string& name, const std::string& text, const FlatFileOptions& options);

std::string error(const std::string& name, const std::string& text,
                  const FlatFileOptions& options = {});

}  // namespace csgrun::testing
