// Many planes put into a table: computed at the same time, entered in order.
#pragma once

#include <cstddef>

#include "engine/base/in_order.h"
#include "engine/exact/plane.h"

namespace csgrun {

/// Calls take(i, make(i)), which enters a plane, for i below count: see make_and_take. What the
/// table will look at is fetched before.
template <class Make, class Take>
void enter_planes(PlaneTable& planes, size_t count, Make&& make, Take&& take) {
  planes.make_room(count);
  make_and_take(count, make, take, [&](const ReducedPlane& plane) { planes.expect(plane); });
}

}  // namespace csgrun
