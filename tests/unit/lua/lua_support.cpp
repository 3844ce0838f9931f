#include "tests/unit/lua/lua_support.h"

#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

namespace csgrun::testing {

SessionOptions test_options() {
  SessionOptions options;
  options.model = "model.lua";
  options.evaluate.threads = 1;
  options.limits.script_seconds = 10;
  options.limits.heap_bytes = size_t{64} << 20;
  return options;
}

ScriptRun::ScriptRun(const std::string& text, SessionOptions options)
    : session(std::move(options)), outcome(run_script(session, "model.lua", text)) {}

void expect_good(const std::string& text) {
  const ScriptRun run(text + "\nemit(cube(1))");
  EXPECT_EQ(run.outcome.status, ScriptStatus::kGood) << text << "\n" << run.outcome.message;
}

std::string message_of(const std::string& text) {
  const ScriptRun run(text);
  EXPECT_NE(run.outcome.status, ScriptStatus::kGood) << text;
  return run.outcome.message.substr(0, run.outcome.message.find('\n'));
}

std::string box_of(const std::string& expression) {
  const ScriptRun run("return " + expression);
  if (run.outcome.status != ScriptStatus::kGood) return run.outcome.message;
  Affine map;
  const Node* node = run.session.parts().at(0).solid.get();
  while (node->kind() != NodeKind::kLeaf) {
    if (node->kind() == NodeKind::kTransform) map = Affine::compose(map, node->transform());
    if (node->children().size() != 1) return "not a leaf";
    node = node->children()[0].get();
  }
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& point : node->mesh()->points) {
    const glm::dvec3 p = map.apply(point);
    low = glm::dvec3(std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z));
    high = glm::dvec3(std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z));
  }
  char text[256];
  std::snprintf(text, sizeof text, "%g %g %g .. %g %g %g", low.x + 0.0, low.y + 0.0, low.z + 0.0,
                high.x + 0.0, high.y + 0.0, high.z + 0.0);
  return text;
}

}  // namespace csgrun::testing
