// Running scripts in tests: the outcome, the parts, the bounding boxes of leaves.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "lua_bindings/script.h"

namespace csgrun::testing {

/// A session with small budgets, so that a test which hangs or grows fails soon.
SessionOptions test_options();

struct ScriptRun {
  explicit ScriptRun(const std::string& text, SessionOptions options = test_options());
  Session session;
  ScriptOutcome outcome;
};

/// Runs a script that must succeed without giving parts: asserts in Lua are its checks.
void expect_good(const std::string& text);

/// The first line of the message of a script that must fail.
std::string message_of(const std::string& text);

/// The bounding box of the only part, which must be a leaf under transforms: "0 0 0 .. 1 1 1".
std::string box_of(const std::string& expression);

}  // namespace csgrun::testing
