// Linked with unit tests, whose models are small: several threads are begun wherever they are asked
// for, not only where they are worth it.
#include "engine/base/parallel.h"

namespace {

[[maybe_unused]] const bool kIsSet = (csgrun::ThreadsFrame::set_alone_time({}), true);

}  // namespace
