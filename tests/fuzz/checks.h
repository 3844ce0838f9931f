// What every fuzz target holds results against. A finding ends the process, as libFuzzer wants it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/engine/solid.h>
#include <csgrun/engine/validate.h>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace csgrun::fuzz {

/// Ends the process with a message: something that must hold does not.
[[noreturn]] inline void fail(const std::string& what) {
  std::fprintf(stderr, "FINDING: %s\n", what.c_str());
  std::abort();
}

inline void expect(bool holds, const std::string& what) {
  if (!holds) fail(what);
}

/// The bytes of an input as text.
inline std::string_view text_of(const uint8_t* data, size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Bad input is the user's fault and has a message; an internal error is ours.
inline void expect_users_fault(const Error& error) {
  expect(error.code != ErrorCode::kInternal, "an internal error: " + error.message);
  expect(!error.message.empty(), "an error without a message");
}

/// A mesh that was accepted as a leaf. Whether a face has area is not asked again: that is judged
/// in doubles from one of its corners, which turning faces over changes.
inline void expect_leaf(const PolygonMesh& mesh) {
  const MeshReport report = check_mesh(mesh);
  expect(report.open_edges == 0 && report.misoriented_edges == 0 && report.bad_indices == 0 &&
             report.non_finite_points == 0,
         "a leaf was accepted that is no good: " + report.text());
}

/// A solid is closed and oriented by index: each directed edge once, and its reverse once.
inline void expect_closed(const Solid& solid) {
  std::vector<std::tuple<uint32_t, uint32_t, bool>> edges;  // low, high, from low to high
  for (const auto& t : solid.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = t[k], b = t[(k + 1) % 3];
      expect(a < solid.positions.size() && a != b, "a triangle with bad corners");
      edges.emplace_back(std::min(a, b), std::max(a, b), a < b);
    }
  }
  std::sort(edges.begin(), edges.end());
  for (size_t i = 0; i < edges.size(); i += 2) {
    const bool paired = i + 1 < edges.size() &&
                        std::get<0>(edges[i]) == std::get<0>(edges[i + 1]) &&
                        std::get<1>(edges[i]) == std::get<1>(edges[i + 1]) &&
                        !std::get<2>(edges[i]) && std::get<2>(edges[i + 1]);
    expect(paired, "the edge " + std::to_string(std::get<0>(edges[i])) + "-" +
                       std::to_string(std::get<1>(edges[i])) + " is not used once a direction");
    expect(
        i + 2 >= edges.size() || std::tie(std::get<0>(edges[i]), std::get<1>(edges[i])) !=
                                     std::tie(std::get<0>(edges[i + 2]), std::get<1>(edges[i + 2])),
        "an edge is used more than twice");
  }
  expect(solid.measures.volume >= 0, "a solid of negative volume");
}

}  // namespace csgrun::fuzz
