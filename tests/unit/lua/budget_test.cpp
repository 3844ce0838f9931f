// Time and memory: what ends a script, and that nothing keeps it alive.
#include <chrono>
#include <memory>
#include <thread>

#include "lua_support.h"

namespace csgrun::testing::budget_test {
namespace {

SessionOptions short_time() {
  SessionOptions options = test_options();
  options.limits.script_seconds = 0.2;
  return options;
}

TEST(TimeBudget, EndsLoopsOfEveryKind) {
  for (const char* script : {
           "while true do end",
           "while true do pcall(function() while true do end end) end",
           "coroutine.wrap(function() while true do pcall(error) end end)()",
           "local function f() return pcall(f) end while true do xpcall(f, f) end",
           "table.sort({3, 1, 2, 5, 4}, function(a, b) while true do pcall(error) end end)",
           "local t = setmetatable({}, {__index = function(t, k) while true do end end}) return "
           "t.x",
           "while true do local t <close> = setmetatable({}, {__close = function() while true do "
           "end end}) end",
           "while true do coroutine.wrap(function() pcall(function() while true do end end) end)() "
           "end",
       }) {
    const auto start = std::chrono::steady_clock::now();
    const ScriptRun run(script, short_time());
    EXPECT_EQ(run.outcome.status, ScriptStatus::kOutOfTime) << script << run.outcome.message;
    EXPECT_NE(run.outcome.message.find("model.lua:1: out of time (limit for the script 0.2 s)"),
              std::string::npos)
        << run.outcome.message;
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5)) << script;
  }
}

TEST(TimeBudget, DefaultsAreThoseOfTheManual) {
  const BudgetLimits limits;
  EXPECT_EQ(limits.script_seconds, 60);
  EXPECT_FALSE(limits.total_seconds.has_value());
  EXPECT_EQ(limits.heap_bytes, size_t{1} << 30);
}

TEST(TimeBudget, DoesNotCountEvaluation) {
  Budget budget({.script_seconds = 0.1, .total_seconds = {}, .heap_bytes = 1 << 20}, "test");
  {
    const EvaluationScope scope(budget);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }
  EXPECT_FALSE(budget.out_of_time());
  EXPECT_GE(budget.evaluation_seconds(), 0.3);
}

// The watchdog sleeps on when an evaluation begins: it wakes while there is no deadline at all.
TEST(TimeBudget, GoesOnAfterAnEvaluationThatIsLongerThanIt) {
  const std::unique_ptr<lua_State, decltype(&lua_close)> state(luaL_newstate(), &lua_close);
  Budget budget({.script_seconds = 1, .total_seconds = {}, .end_process = false}, "test");
  budget.start_script(state.get());
  {
    const EvaluationScope scope(budget);
    std::this_thread::sleep_for(std::chrono::milliseconds(1300));
    EXPECT_FALSE(budget.out_of_time());
  }
  const auto start = std::chrono::steady_clock::now();
  const auto passed = [&] { return std::chrono::steady_clock::now() - start; };
  while (!budget.out_of_time() && passed() < std::chrono::seconds(20)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(budget.out_of_time());
  EXPECT_GE(passed(), std::chrono::milliseconds(500));  // most of its second was left
}

TEST(TimeBudget, TotalTimeCountsEverything) {
  Budget budget({.script_seconds = 60, .total_seconds = 0.1, .heap_bytes = 1 << 20}, "test");
  const EvaluationScope scope(budget);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_TRUE(budget.cancel().load());
}

TEST(MemoryBudget, IsAnErrorWithItsPlace) {
  for (const char* script : {
           "\nlocal t = {} for i = 1, 1e9 do t[i] = {} end",
           "\nreturn ('x'):rep(200 * 1000 * 1000)",
           "\nlocal s = 'x' while true do s = s .. s end",
       }) {
    const ScriptRun run(script);
    EXPECT_EQ(run.outcome.status, ScriptStatus::kFailed);
    EXPECT_EQ(run.outcome.message, "model.lua:2: not enough memory (script limit 64 MB)") << script;
  }
}

TEST(MemoryBudget, CountsTheMeshesOfSolids) {
  EXPECT_EQ(message_of("local t = {} for i = 1, 1000 do t[i] = sphere(10, {fn = 100}) end"),
            "model.lua:1: not enough memory (script limit 64 MB)");
}

TEST(MemoryBudget, DroppedMeshesAreFreed) {
  expect_good("for i = 1, 300 do local s = sphere(10, {fn = 100}) end");
}

TEST(MemoryBudget, CanBeCaught) {
  expect_good("assert(not pcall(function() local t = {} for i = 1, 1e9 do t[i] = {} end end))");
}

TEST(DeepStructures, AreBuiltAndFreedInAnOrdinaryStack) {
  expect_good("local s = cube(1) for i = 1, 100000 do s = s + cube(1) end");
  expect_good("local s = cube(1) for i = 1, 100000 do s = s:translate(1, 0, 0) end");
  expect_good("local s, x = cube(1), cube(2) for i = 1, 100000 do s = x - s end");
  expect_good("local t = {} for i = 1, 100000 do t = {t} end");
}

}  // namespace
}  // namespace csgrun::testing::budget_test
