// A leaf as the engine prepares it for its jobs: with what it knows of the surface.
#pragma once

#include <memory>

namespace csgrun {
struct LeafGeometry;
}  // namespace csgrun

namespace csgrun::test {

/// The same solid, knowing which edges are opposite, whether it is convex, what touches; its faces
/// may be others over the same surface. The leaf itself where it does not bound a solid.
std::shared_ptr<const LeafGeometry> as_prepared(std::shared_ptr<const LeafGeometry> leaf);

}  // namespace csgrun::test
