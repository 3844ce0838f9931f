#include "tests/support/touches_told.h"

#include <gtest/gtest.h>

#include "engine/mesh/present.h"
#include "tests/support/kernel_case.h"

namespace csgrun::test {

void expect_touches_told(const BoundaryMesh& mesh, const std::string& what) {
  BoundaryMesh anywhere = mesh;
  anywhere.touches.clear();
  anywhere.may_touch = true;
  for (const bool join : {false, true}) {
    PresentContext context = test_context();
    context.join_contacts = join;
    const auto told = present(mesh, context), found = present(anywhere, context);
    ASSERT_TRUE(told && found) << what;
    EXPECT_EQ(difference_between(**told, **found), "") << what;
  }
}

}  // namespace csgrun::test
