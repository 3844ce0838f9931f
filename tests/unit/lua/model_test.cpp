// Parts, parameters, files: what connects a script with the world.
#include <filesystem>
#include <fstream>

#include <sys/stat.h>
#include <unistd.h>

#include "lua_bindings/colors.h"
#include "lua_bindings/nearest.h"
#include "lua_support.h"

namespace csgrun::testing::model_test {
namespace {

std::string part_names(const std::string& script) {
  const ScriptRun run(script);
  if (run.outcome.status != ScriptStatus::kGood) return run.outcome.message;
  std::string names;
  for (const ScriptPart& part : run.session.parts())
    names += (names.empty() ? "" : " ") + part.name;
  return names;
}

TEST(Parts, ComeInADefinedOrder) {
  EXPECT_EQ(part_names("return cube(1)"), "part1");
  EXPECT_EQ(part_names("return {cube(1), zeta = cube(1), alpha = cube(1), cube(2)}"),
            "part1 part2 alpha zeta");
  EXPECT_EQ(part_names("emit(cube(1), {name = 'x'}) render(cube(2)) return {y = cube(3)}"),
            "x part1 y");
  EXPECT_EQ(part_names("return {case = {lid = cube(1), cube(2)}, cube(3)}"),
            "part1 case/part1 case/lid");
  EXPECT_EQ(part_names("return cube(1), cube(2)"), "part1 part2");
  EXPECT_EQ(part_names("emit{lid = cube(1), box = cube(1)}"), "box lid");
  EXPECT_EQ(part_names("emit({cube(1), cube(2)}, {name = 'g'})"), "g/part1 g/part2");
  // Numbers that given names have are left out, also those of later parts.
  EXPECT_EQ(part_names("emit(cube(1), 'part1') return cube(2)"), "part1 part2");
  EXPECT_EQ(part_names("emit(cube(1)) emit(cube(2)) emit(cube(3), 'part2') emit(cube(4), 'part1')"),
            "part3 part4 part2 part1");
  EXPECT_EQ(part_names("local a, b = cube(2):name('a'):split({0, 0, 1}, 1) return a, b"),
            "part1 part2");
  EXPECT_EQ(part_names("return cube(2):name('a'):trim({0, 0, 1}, 1)"), "a");
  EXPECT_EQ(part_names("return square(2):name('a'):linear_extrude(1), "
                       "circle(2):right(3):name('b'):rotate_extrude()"),
            "a b");
  EXPECT_EQ(part_names("emit(cube(1), 'x') render(cube(2), cube(3), 'g')"), "x g/part1 g/part2");
}

TEST(Parts, Mistakes) {
  EXPECT_EQ(message_of("local x = cube(1)\n\n"),
            "model.lua:1: the script makes no part: return a solid, or call emit(solid)");
  EXPECT_EQ(message_of("\nreturn 5"),
            "model.lua:2: a part must be a solid, a shape or a table of them, got 5");
  EXPECT_EQ(message_of("return {a = 5}"),
            "model.lua:1: a part must be a solid, a shape or a table of them, got 5 for 'a'");
  EXPECT_EQ(message_of("return function() return cube(1) end"),
            "model.lua:1: a part must be a solid, a shape or a table of them, got function; what "
            "it returns is a part: call it");
  EXPECT_EQ(message_of("return {[''] = cube(1)}"),
            "model.lua:1: '' cannot be a part's name: leave it out, or say one");
  EXPECT_EQ(message_of("emit('lid', cube(1))"),
            "model.lua:1: emit: the part stands first, then its name");
  EXPECT_EQ(message_of("emit(cube(1), {name = 'a'}) return {a = cube(2)}"),
            "model.lua:1: there are two parts named 'a'");
  for (const std::string call : {"emit", "render"}) {
    for (const std::string name : {"''", "{name = ''}"}) {
      EXPECT_EQ(message_of(call + "(cube(1), " + name + ")"),
                "model.lua:1: " + call + ": option 'name' must not be empty");
    }
  }
  EXPECT_NE(message_of("return {['../x'] = cube(1)}").find("cannot be a part's name"),
            std::string::npos);
  for (const char* script : {"return {['a\\0b\\n'] = cube(1)}", "return cube(1):name('a\\0b\\n')"})
    EXPECT_EQ(message_of(script).find("model.lua:1: 'a\\0b\\10' cannot be a part's name"), 0)
        << script;
  EXPECT_NE(message_of("return {['a\\1b'] = cube(1)}").find("cannot be a part's name"),
            std::string::npos);
  EXPECT_EQ(message_of("return {['a//b'] = cube(1)}"),
            "model.lua:1: 'a//b' cannot be a part's name: it must not be empty, '.' or '..', nor "
            "have such a step between slashes, nor backslashes or control characters in it");
  EXPECT_NE(message_of("local t = {} t[1] = t return t").find("nested too deep"),
            std::string::npos);
  EXPECT_NE(message_of("return {cube(1), nil, cube(2)}").find("hole"), std::string::npos);
}

TEST(Surfaces, Mistakes) {
  EXPECT_EQ(message_of("return outer_hull(cube(1), {keep_void = true})"),
            "model.lua:1: outer_hull: unknown option 'keep_void' (did you mean 'keep_voids'?)");
  EXPECT_NE(
      message_of("return outer_hull(5)").find("outer_hull: the first argument must be a solid"),
      std::string::npos);
  EXPECT_EQ(message_of("csg.contacts = 'seperate'"),
            "model.lua:1: csg.contacts must be \"separate\" or \"join\", got \"seperate\" (did you "
            "mean 'separate'?)");
  EXPECT_EQ(message_of("csg.contacts = 3"),
            "model.lua:1: csg.contacts must be \"separate\" or \"join\", got 3");
  const std::string tetrahedron =
      "return polyhedron{points = {{0,0,0},{1,0,0},{0,1,0},{0,0,1}},"
      "faces = {{0,1,2},{0,3,1},{0,2,3},{1,3,2}}, fill = ";
  EXPECT_EQ(
      message_of(tetrahedron + "'even-odd'}"),
      "model.lua:1: polyhedron: option 'fill' must be \"nonzero\", \"positive\" or \"evenodd\", "
      "got \"even-odd\" (did you mean 'evenodd'?)");
  EXPECT_EQ(ScriptRun(tetrahedron + "'evenodd'}").outcome.status, ScriptStatus::kGood);
}

ScriptRun run_with(const std::string& script, std::vector<Definition> definitions) {
  SessionOptions options = test_options();
  options.definitions = std::move(definitions);
  return ScriptRun(script + "\nemit(cube(1))", std::move(options));
}

TEST(Parameters, TakeTheTypeOfTheirDefault) {
  const auto good = [](const std::string& script, const std::string& text) {
    const ScriptRun run = run_with(script, {{"p", text}});
    EXPECT_EQ(run.outcome.status, ScriptStatus::kGood)
        << script << " " << text << " " << run.outcome.message;
  };
  good("assert(param('p', 4) == 5.5)", "5.5");
  good("assert(param('p', 4) == -3)", "-3");
  good("assert(param('p', true) == false)", "false");
  good("assert(param('p', 'x') == 'hello world')", "hello world");
  good("assert(param('p', 'x') == 'hello')", "\"hello\"");
  good("assert(param('p', 'x') == '5')", "5");
  good("local v = param('p', {1, 2, 3}) assert(#v == 3 and v[3] == 7)", "[5, 6, 7]");
  good("local v = param('p', {}, {doc = 'any'}) assert(#v == 3 and v[3] == 7)", "[5, 6, 7]");
  good("local v = param('p', {1, 2}) assert(#v == 2 and v[1] == 0.5)", "{0.5,1e1}");
  good("assert(param('p', 'b', {choices = {'a', 'b'}}) == 'a')", "a");
}

TEST(Parameters, ThatDoNotFitAreUsageErrors) {
  const auto bad = [](const std::string& script, const std::string& text,
                      const std::string& message) {
    const ScriptRun run = run_with(script, {{"p", text}});
    EXPECT_EQ(run.outcome.status, ScriptStatus::kUsage);
    EXPECT_EQ(run.outcome.message, "-D p=" + text + ": 'p' " + message);
  };
  bad("param('p', 4)", "abc", "must be a number");
  bad("param('p', 4)", "0x", "must be a number");
  bad("param('p', 4)", "inf", "must be a number");
  bad("param('p', true)", "1", "must be true or false");
  bad("param('p', {1})", "1", "must be a list of numbers");
  bad("param('p', {1, 2, 3})", "[1, 2]", "must be a list of 3 numbers, as its default is, got 2");
  bad("param('p', 4, {min = 1, max = 10})", "11", "must be at most 10, got 11");
  bad("param('p', 4, {min = 1, max = 10})", "0", "must be at least 1, got 0");
  bad("param('p', 4, {step = 2})", "5", "must be a whole number of steps of 2 from 0, got 5");
  bad("param('p', 'b', {choices = {'a', 'b'}})", "c", "must be one of a, b");
  bad("pcall(param, 'p', 4)", "abc", "must be a number");  // a script cannot hide it
}

TEST(Parameters, ThatNobodyAskedFor) {
  const ScriptRun run = run_with("param('hole_radius', 4)", {{"hole_radis", "5"}});
  EXPECT_EQ(run.outcome.status, ScriptStatus::kUsage);
  EXPECT_EQ(run.outcome.message,
            "-D hole_radis: the model has no such parameter (did you mean 'hole_radius'?)");
  const std::string hint =
      " sets a variable of that name; width = param(\"width\", DEFAULT) makes it one)";
  const auto message = [](const std::string& text) {
    return run_with(text + "\nparam('with', 4)", {{"width", "5"}}).outcome.message;
  };
  const std::string problem = "-D width: the model has no such parameter (";
  EXPECT_EQ(message("local w = 1\n  local\twidth = 3"), problem + "line 2" + hint);
  EXPECT_EQ(message("local w = 1\n  local  width\t= 3"), problem + "line 2" + hint);
  EXPECT_EQ(message("width = 3"), problem + "line 1" + hint);
  for (const char* const other :
       {"local function f(width) return\nwidth == 3 end", "widths = 3", "-- width = 3"}) {
    EXPECT_EQ(message(other), problem + "did you mean 'with'?)") << other;
  }
}

TEST(Parameters, ABadDefaultIsTheScriptsFault) {
  EXPECT_EQ(message_of("param('p', 20, {max = 10})"),
            "model.lua:1: param: the default of 'p' must be at most 10, got 20");
  EXPECT_NE(message_of("param('p', print)").find("must be a number, true or false"),
            std::string::npos);
}

TEST(Parameters, VarIsAParameterNamedByItsMeaning) {
  EXPECT_EQ(run_with("assert(var('Radius of hole', 4) == 4)", {}).outcome.status,
            ScriptStatus::kGood);
  EXPECT_EQ(
      run_with("assert(var('Radius of hole', 4) == 7)", {{"Radius of hole", "7"}}).outcome.status,
      ScriptStatus::kGood);
  EXPECT_EQ(run_with("var('Radius', 4)", {{"Radius", "x"}}).outcome.message,
            "-D Radius=x: 'Radius' must be a number");
  EXPECT_EQ(message_of("var('Radius')"), "model.lua:1: var: needs a name and a default value");
}

TEST(Parameters, OptionsMustFitTheDefault) {
  EXPECT_EQ(message_of("param('p', true, {min = 1})"),
            "model.lua:1: param: option 'min' goes with numbers, and the default of 'p' is true or "
            "false");
  EXPECT_EQ(message_of("param('p', 'a', {choices = {'a', 1}})"),
            "model.lua:1: param: choice 2 of 'p' must be a string, as its default is, got 1");
  EXPECT_EQ(message_of("param('p', 'a', {choices = 'a'})"),
            "model.lua:1: param: option 'choices' must be a list of values, got the string \"a\"");
  EXPECT_EQ(message_of("param('p', 1, {chioces = {1}})"),
            "model.lua:1: param: unknown option 'chioces' (did you mean 'choices'?)");
}

TEST(Parameters, AreKnownAfterTheRun) {
  const ScriptRun run = run_with(
      "param('n', 4, {min = 1, max = 9, step = 0.5, doc = 'how many'}) "
      "param('n', 4, {min = 1, max = 9, step = 0.5}) "
      "param('on', true) param('size', {1, 2})",
      {{"n", "6"}});
  ASSERT_EQ(run.session.parameters.size(), 3u);
  const Parameter& n = run.session.parameters[0];
  EXPECT_EQ(n.name, "n");
  EXPECT_EQ(n.doc, "how many");
  EXPECT_EQ(n.fallback, ParameterValue(4.0));
  EXPECT_EQ(n.step, 0.5);
  EXPECT_EQ(run.session.parameters[2].fallback, ParameterValue(std::vector<double>{1, 2}));
}

TEST(Settings, FacetsOfTheSession) {
  expect_good("csg.fn = 7 assert(csg.fn == 7) csg.fa = 1 csg.fs = 0.5");
  EXPECT_EQ(message_of("csg.fn = -1"), "model.lua:1: csg.fn must be from 0 to 100000, got -1");
  EXPECT_EQ(message_of("csg.fm = 1"), "model.lua:1: csg has no setting 'fm' (did you mean 'fa'?)");
  EXPECT_EQ(box_of("(function() csg.fn = 4 return cylinder(1, 2) end)()"), "-2 -2 0 .. 2 2 1");
}

/// A folder of its own for each test, with a model's folder in it.
class FilesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = std::filesystem::temp_directory_path() / ("csgrun_lua_" + std::to_string(::getpid()));
    std::filesystem::create_directories(root_ / "model/sub");
    std::filesystem::create_directories(root_ / "library");
  }
  void TearDown() override { std::filesystem::remove_all(root_); }

  void write(const std::string& path, const std::string& text) const {
    std::ofstream(root_ / path) << text;
  }
  std::string run(const std::string& script) const {
    SessionOptions options = test_options();
    options.model = (root_ / "model/model.lua").string();
    options.model_folder = (root_ / "model").string();
    options.library_folders = {(root_ / "library").string()};
    Session session(options);
    const ScriptOutcome outcome = run_script(session, options.model, script + "\nemit(cube(1))");
    if (outcome.status == ScriptStatus::kGood) return "good";
    // Without the folder, which differs from run to run.
    std::string message = outcome.message.substr(0, outcome.message.find("\nstack traceback"));
    for (size_t at; (at = message.find(root_.string() + "/")) != std::string::npos;) {
      message.erase(at, root_.string().size() + 1);
    }
    return message;
  }

  std::filesystem::path root_;
};

TEST_F(FilesTest, ModulesAreFoundInOrderAndRunOnce) {
  write("model/a.lua", "count = (rawget(_G, 'count') or 0) + 1 return {n = count, name = ...}");
  write("model/sub/init.lua", "return 'sub'");
  write("library/b.lua", "return 'library'");
  write("library/a.lua", "return 'never'");
  EXPECT_EQ(run("local a = require 'a' assert(a.n == 1 and a.name == 'a' and require('a') == a and "
                "count == 1)"),
            "good");
  EXPECT_EQ(run("assert(require 'sub' == 'sub' and require 'b' == 'library')"), "good");
  EXPECT_EQ(run("assert(require 'csg' == csg)"), "good");
  EXPECT_EQ(run("require 'none.x'"),
            "model/model.lua:1: require: module 'none.x' not found:\n\tno file 'model/none/x.lua'\n"
            "\tno file 'model/none/x/init.lua'\n\tno file 'model/csgrun_modules/none/x.lua'\n"
            "\tno file 'model/csgrun_modules/none/x/init.lua'\n\tno file 'library/none/x.lua'\n"
            "\tno file 'library/none/x/init.lua'");
  const std::string named = "model/model.lua:1: require: module 'b.lua' not found (names have no ";
  EXPECT_EQ(run("require 'b.lua'").find(named + "ending: require \"b\"):\n\tno file"), 0u);
  EXPECT_TRUE(run("import 'b.lua'").ends_with(".dxf; a script is read by require \"name\""));
}

TEST_F(FilesTest, PackagePathAddsFoldersInsideTheLimits) {
  std::filesystem::create_directories(root_ / "model/lib/deep");
  write("model/lib/a.lua", "return 'lib'");
  write("model/lib/deep/init.lua", "return 'deep'");
  write("model/a.lua", "return 'model'");
  write("secret.lua", "return 1");
  write("library/far.lua", "return 'far'");
  EXPECT_EQ(run("package.path = './lib/?.lua;' .. package.path assert(require 'a' == 'lib')"),
            "good");
  EXPECT_EQ(run("package.path = package.path .. ';lib/?.lua;lib/?/init.lua'\n"
                "assert(require 'a' == 'model' and require 'deep' == 'deep')"),
            "good");
  EXPECT_EQ(run("package.path = '" + (root_ / "library").string() +
                "/?.lua' assert(require 'far' == 'far')"),
            "good");
  // Whatever stands in the templates, the border stays where it is, and tells nothing.
  for (const char* name : {"secret", "none"}) {
    const std::string message =
        run(std::string("package.path = './../?.lua' require '") + name + "'");
    EXPECT_NE(message.find(std::string("'model/../") + name + ".lua' leads outside"),
              std::string::npos)
        << message;
  }
  EXPECT_NE(run("package.path = '/etc/?;/etc/hostname' require 'hostname'").find("not found"),
            std::string::npos);
  EXPECT_NE(run("package.path = nil require 'a'").find("package.path must be a string"),
            std::string::npos);
  EXPECT_NE(run("package = 5 require 'a'").find("package.path must be a string"),
            std::string::npos);
  EXPECT_NE(run("local x = package.loaded").find("'package.loaded' is not available"),
            std::string::npos);
}

TEST_F(FilesTest, ErrorsInModulesNameTheModule) {
  write("model/bad.lua", "\n\nlocal x = = 1");
  write("model/deep.lua", "return {f = function()\n  error('broken')\nend}");
  write("model/code.lua", "\x1bLuaT");
  write("model/loop.lua", "return require 'loop'");
  EXPECT_EQ(run("require 'bad'"), "model/bad.lua:3: unexpected symbol near '='");
  EXPECT_EQ(run("require('deep').f()"), "model/deep.lua:2: broken");
  EXPECT_EQ(run("require 'code'"), "model/code.lua:1: this is Lua bytecode; only text is accepted");
  EXPECT_EQ(run("require 'loop'"),
            "model/loop.lua:1: require: module 'loop' requires itself while it is loaded");
  // What failed runs again.
  EXPECT_EQ(run("pcall(require, 'bad') require 'bad'"),
            "model/bad.lua:3: unexpected symbol near '='");
  write("model/late.lua", "assert(ready, 'not yet') return 7");
  EXPECT_EQ(run("ready = false assert(not pcall(require, 'late')) ready = true "
                "assert(require 'late' == 7)"),
            "good");
}

TEST_F(FilesTest, NothingOutsideCanBeReached) {
  write("secret.lua", "return 1");
  write("secret.stl", "solid x\nendsolid x\n");
  std::filesystem::create_symlink(root_ / "secret.lua", root_ / "model/link.lua");
  std::filesystem::create_symlink(root_ / "secret.stl", root_ / "model/link.stl");
  std::filesystem::create_symlink("/dev/zero", root_ / "model/zero.stl");
  std::filesystem::create_directory(root_ / "model/folder.stl");
  ASSERT_EQ(::mkfifo((root_ / "model/pipe.stl").c_str(), 0600), 0);
  const std::string outside = "' lies outside of the model's folder and the library folders (-L)";
  EXPECT_EQ(run("import '../secret.stl'"), "model/model.lua:1: import: '../secret.stl" + outside);
  EXPECT_EQ(run("import '../none.stl'"), "model/model.lua:1: import: '../none.stl" + outside);
  EXPECT_EQ(run("import 'sub/../../secret.stl'"),
            "model/model.lua:1: import: 'sub/../../secret.stl" + outside);
  EXPECT_EQ(run("import 'link.stl'"), "model/model.lua:1: import: 'link.stl" + outside);
  EXPECT_EQ(run("import 'zero.stl'"), "model/model.lua:1: import: 'zero.stl" + outside);
  EXPECT_EQ(run("import '/etc/hostname.stl'"),
            "model/model.lua:1: import: '/etc/hostname.stl" + outside);
  EXPECT_EQ(run("import 'pipe.stl'"),
            "model/model.lua:1: import: cannot read 'pipe.stl': it is a FIFO");
  EXPECT_EQ(run("import 'folder.stl'"),
            "model/model.lua:1: import: cannot read 'folder.stl': it is a directory");
  EXPECT_EQ(
      run("import 'none.stl'"),
      "model/model.lua:1: import: cannot read 'none.stl': No such file or directory; looked in "
      "'model', 'library'");
  EXPECT_NE(run("require 'link'").find("leads outside"), std::string::npos);
  for (const char* name : {"../secret", "..secret", "/etc/x", "a/b", "a..b", ".a", ""}) {
    EXPECT_NE(run(std::string("require '") + name + "'").find("require: "), std::string::npos)
        << name;
    EXPECT_NE(run(std::string("assert(pcall(require, '") + name + "'))"), "good") << name;
  }
  // A chunk may call itself what it likes: that moves the start of its paths, not the border.
  EXPECT_NE(run("load(\"import 'secret.stl'\", '@" + (root_ / "x.lua").string() + "')()")
                .find("lies outside"),
            std::string::npos);
}

TEST_F(FilesTest, ImportsAreRelativeToTheFileThatCalls) {
  const std::string off =
      "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  write("model/sub/t.off", off);
  write("model/sub/m.lua", "return import 't.off'");
  EXPECT_EQ(run("require 'sub.m' import 'sub/t.off'"), "good");
  EXPECT_EQ(run("import 't.off'"),
            "model/model.lua:1: import: cannot read 't.off': No such file or directory; looked in "
            "'model', 'library'");
}

TEST(Nearest, NamesWithinOneEditInThreeLetters) {
  const std::vector<std::string> names = {"cube", "sphere", "cylinder", "translate", "r", "d"};
  EXPECT_EQ(nearest_name("cub", names), "cube");
  EXPECT_EQ(nearest_name("Cube", names), "cube");
  EXPECT_EQ(nearest_name("shpere", names), "sphere");
  EXPECT_EQ(nearest_name("cilinder", names), "cylinder");
  EXPECT_EQ(nearest_name("translation", names), "translate");
  EXPECT_EQ(nearest_name("banana", names), "");
  EXPECT_EQ(nearest_name("", names), "");
  EXPECT_EQ(nearest_name("n", names), "");  // one edit of a letter is any other letter
  EXPECT_EQ(nearest_name("x", names), "");
  EXPECT_EQ(nearest_name("R", names), "r");
}

TEST(Colors, NamesAndHexadecimal) {
  EXPECT_EQ(parse_color("SteelBlue"),
            (std::array<float, 4>{70 / 255.0F, 130 / 255.0F, 180 / 255.0F, 1}));
  EXPECT_EQ(parse_color("#fff"), (std::array<float, 4>{1, 1, 1, 1}));
  EXPECT_EQ(parse_color("#FF000080"), (std::array<float, 4>{1, 0, 0, 128 / 255.0F}));
  for (const char* bad : {"", "#", "#ff", "#ggg", "#fffff", "nocolour"})
    EXPECT_FALSE(parse_color(bad)) << bad;
}

TEST(Booleans, BuildTheTreeThatIsMeant) {
  const auto root = [](const std::string& expression) {
    return ScriptRun("return " + expression).session.parts().at(0).solid;
  };
  EXPECT_EQ(root("cube(1) + cube(2)")->op(), BooleanOp::kUnion);
  EXPECT_EQ(root("cube(1) | cube(2)")->op(), BooleanOp::kUnion);
  EXPECT_EQ(root("cube(1) - cube(2)")->op(), BooleanOp::kDifference);
  EXPECT_EQ(root("cube(1) * cube(2)")->op(), BooleanOp::kIntersection);
  EXPECT_EQ(root("cube(1) & cube(2)")->op(), BooleanOp::kIntersection);
  EXPECT_EQ(root("cube(1) ~ cube(2)")->op(), BooleanOp::kSymmetricDifference);
  EXPECT_EQ(root("union{cube(1), cube(2), cube(3)}")->children().size(), 3u);
  EXPECT_EQ(root("difference(cube(1), {cube(2), cube(3)})")->children().size(), 3u);
  EXPECT_EQ(root("cube(1):intersection(cube(2))")->op(), BooleanOp::kIntersection);
  EXPECT_EQ(root("union{}")->kind(), NodeKind::kEmpty);
  EXPECT_EQ(root("union{cube(1), {cube(2), {cube(3), {}}}}")->children().size(), 3u);
  EXPECT_EQ(message_of("local t = {} t[1] = t return union(t)"),
            "model.lua:1: union: its lists are nested too deep (does one contain itself?)");
  const ScriptRun run("local a = cube(1)\nlocal b = a +\n  cube(2)\nreturn b");
  EXPECT_EQ(run.session.parts().at(0).solid->where().text(), "model.lua:2");
}

}  // namespace
}  // namespace csgrun::testing::model_test
