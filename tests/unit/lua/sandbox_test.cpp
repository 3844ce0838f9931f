// What the sandbox keeps out, and what it makes the same on every run.
#include "lua_support.h"

namespace csgrun::testing::sandbox_test {
namespace {

TEST(Sandbox, HasNoWayOut) {
  for (const char* name : {"io", "os", "debug", "dofile", "loadfile"}) {
    const std::string message = message_of(std::string("return ") + name);
    EXPECT_EQ(message.rfind(std::string("model.lua:1: '") + name + "' is not available", 0), 0u)
        << message;
    expect_good(std::string("assert(rawget(_G, '") + name + "') == nil)");
  }
  expect_good("assert(string.dump == nil)");
  expect_good("assert(getmetatable(_G) == false and getmetatable(cube(1)) == 'solid')");
  EXPECT_EQ(message_of("setmetatable(_G, {})"), "model.lua:1: cannot change a protected metatable");
}

TEST(Sandbox, TakesNoBytecode) {
  expect_good(
      R"(local f, why = load("\27Lua", "x", "b") assert(f == nil and why:find("mode is 't'")))");
  expect_good(R"(local f, why = load("\27Lua", "x", "bt") assert(f == nil))");
  expect_good("assert(load('return 5')() == 5)");
  expect_good("assert(load('return x', 'x', 't', {x = 7})() == 7)");
  EXPECT_EQ(message_of("\x1bLua"), "model.lua:1: this is Lua bytecode; only text is accepted");
}

TEST(Sandbox, RefusesFinalizers) {
  EXPECT_EQ(message_of("setmetatable({}, {__gc = print})"),
            "model.lua:1: setmetatable: '__gc' is not available to models");
  EXPECT_EQ(message_of("setmetatable({}, {__gc = true})"),
            "model.lua:1: setmetatable: '__gc' is not available to models");
  expect_good("local t = setmetatable({}, {__index = {a = 1}}) assert(t.a == 1)");
}

TEST(Sandbox, ShowsNoAddresses) {
  expect_good("assert(tostring({}) == 'table' and tostring(print) == 'function')");
  expect_good("assert(tostring(cube(1)) == 'solid' and tostring(square(1)) == 'shape')");
  expect_good("assert(tostring(coroutine.create(print)) == 'thread')");
  expect_good("assert(('%s|%5s|%d%%'):format({}, nil, 3) == 'table|  nil|3%')");
  expect_good(
      "assert(tostring(setmetatable({}, {__tostring = function() return 'me' end})) == 'me')");
  expect_good("assert(tostring(setmetatable({}, {__name = 'mine'})) == 'mine')");
  EXPECT_EQ(message_of("return ('%p'):format({})"),
            "model.lua:1: string.format: '%p' is not available: addresses differ from run to run");
}

TEST(Sandbox, RandomNumbersAreTheSame) {
  expect_good(
      "local a = math.random(1000000) math.randomseed(20100501) assert(math.random(1000000) == a)");
  EXPECT_NE(message_of("math.randomseed()").find("number expected"), std::string::npos);
}

TEST(Sandbox, TellsNothingOfTheMachine) {
  expect_good("assert(collectgarbage('count') == 0 and collectgarbage() == 0)");
}

TEST(UndefinedGlobals, AreErrorsWithTheNearestName) {
  EXPECT_EQ(message_of("\n\nreturn cub(1)"),
            "model.lua:3: undefined variable 'cub' (did you mean 'cube'?)");
  EXPECT_EQ(message_of("return Cube(1)"),
            "model.lua:1: undefined variable 'Cube' (did you mean 'cube'?)");
  EXPECT_EQ(message_of("width = 3 return widht"),
            "model.lua:1: undefined variable 'widht' (did you mean 'width'?)");
  EXPECT_EQ(message_of("return xyzzy"), "model.lua:1: undefined variable 'xyzzy'");
  expect_good("x = 5 assert(x == 5)");
}

TEST(OrderedPairs, NumbersThenStringsThenBooleans) {
  expect_good(R"(
    local seen = {}
    for k in pairs({zeta = 1, alpha = 1, [3] = 1, [-1] = 1, [2.5] = 1, [1] = 1, [true] = 1, [false] = 1, [2^53] = 1, Beta = 1}) do
      seen[#seen + 1] = tostring(k)
    end
    assert(table.concat(seen, " ") == "-1 1 2.5 3 9007199254740992 Beta alpha zeta false true", table.concat(seen, " ")))");
}

TEST(OrderedPairs, LargeIntegersAndFloatsCompareExactly) {
  expect_good(R"(
    local big = math.maxinteger
    local seen = {}
    for k in pairs({[big] = 1, [big - 1] = 1, [2.0^62 + 1024] = 1, [math.mininteger] = 1}) do seen[#seen + 1] = k end
    assert(seen[1] == math.mininteger and seen[2] == 2^62 + 1024 and seen[3] == big - 1 and seen[4] == big))");
}

TEST(OrderedPairs, ObjectsInTheOrderOfTheirMaking) {
  expect_good(R"(
    local t, made = {}, {}
    for i = 1, 20 do made[i] = setmetatable({i = i}, {}) end
    for i = 20, 1, -1 do t[made[i]] = true end
    local last = 0
    for k in pairs(t) do assert(k.i == last + 1) last = k.i end
    assert(last == 20)
    local a, b = cube(1), cube(2)
    local names = ""
    for _, name in pairs({[b] = "b", [a] = "a"}) do names = names .. name end
    assert(names == "ab"))");
  EXPECT_NE(message_of("for k in pairs({[{}] = 1, [{}] = 2}) do end")
                .find("would differ from run to run"),
            std::string::npos);
}

TEST(OrderedPairs, KeysMayBeRemovedOnTheWay) {
  expect_good(R"(
    local t, n = {}, 0
    for i = 1, 100 do t["k" .. i] = i end
    for k in pairs(t) do t[k] = nil n = n + 1 end
    assert(n == 100 and next(t) == nil)
    local u = {a = 1, b = 2, c = 3}
    local seen = ""
    for k in pairs(u) do seen = seen .. k u.b = nil end
    assert(seen == "ac"))");
}

TEST(OrderedPairs, RespectsThePairsMetamethod) {
  expect_good(R"(
    local t = setmetatable({}, {__pairs = function() return function(_, k) if not k then return 1, 2 end end, nil, nil end})
    local n = 0
    for k, v in pairs(t) do n = n + 1 assert(k == 1 and v == 2) end
    assert(n == 1))");
}

TEST(Next, WalksInOrderAlsoInterleaved) {
  expect_good(R"(
    local t, u = {c = 3, a = 1, b = 2}, {z = 1, y = 2}
    assert(next(t) == "a" and next(t, "a") == "b" and next(u) == "y" and next(t, "b") == "c" and next(u, "y") == "z")
    assert(next(t, "c") == nil and next(u, "z") == nil and next({}) == nil)
    t.aa = 4
    assert(next(t, "a") == "aa")
    local queue, order = {}, ""
    for i = 1, 5 do queue["q" .. i] = true end
    while true do
      local k = next(queue)
      if k == nil then break end
      order = order .. k
      queue[k] = nil
    end
    assert(order == "q1q2q3q4q5"))");
}

TEST(Traceback, NamesEveryFrame) {
  const ScriptRun run(
      "local function f()\n  error('deep')\nend\nlocal function g()\n  f()\nend\ng()\n");
  EXPECT_EQ(run.outcome.message,
            "model.lua:2: deep\nstack traceback:\n\t[C]: in global 'error'\n\tmodel.lua:2: in "
            "upvalue 'f'\n"
            "\tmodel.lua:5: in local 'g'\n\tmodel.lua:7: in main chunk");
}

TEST(Traceback, OfADeepStackIsShort) {
  const ScriptRun run(
      "local function f(n) if n == 0 then error('x') end f(n - 1) return 1 end f(100000)");
  EXPECT_LT(run.outcome.message.size(), 3000u);
  EXPECT_NE(run.outcome.message.find("levels)"), std::string::npos);
}

TEST(Errors, OfAnyTypeHaveAPlace) {
  EXPECT_EQ(message_of("\nerror({})"), "model.lua:2: error value of type table");
  EXPECT_EQ(message_of("\nerror(setmetatable({}, {__tostring = function() return 'mine' end}))"),
            "model.lua:2: mine");
  EXPECT_EQ(message_of("x = = 1"), "model.lua:1: unexpected symbol near '='");
  EXPECT_EQ(message_of("\nlocal t = nil\nreturn t.x"),
            "model.lua:3: attempt to index a nil value (local 't')");
}

}  // namespace
}  // namespace csgrun::testing::sandbox_test
