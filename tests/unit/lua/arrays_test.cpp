// Anchors, alignment, copies; transforms as values; files as values.
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "lua_support.h"

namespace csgrun::testing::arrays_test {
namespace {

/// The bounding box and the volume of an expression: "0 0 0 .. 1 1 1 = 1".
std::string measure_of(const std::string& expression) {
  ScriptRun run("return " + expression);
  if (run.outcome.status != ScriptStatus::kGood)
    return run.outcome.message.substr(0, run.outcome.message.find('\n'));
  const Extent e = run.session.extent(SolidValue(run.session.parts().at(0).solid));
  char text[256];
  std::snprintf(text, sizeof text, "%g %g %g .. %g %g %g = %g", e.bbox[0].x, e.bbox[0].y,
                e.bbox[0].z, e.bbox[1].x, e.bbox[1].y, e.bbox[1].z, e.volume);
  return text;
}

TEST(Anchors, ArePlacesOfTheBox) {
  expect_good(
      "local p = cube(10, 20, 30):anchor('top-right') assert(p[1] == 10 and p[2] == 10 and p[3] == "
      "30)");
  expect_good("local p = cube(10):anchor() assert(p[1] == 5 and p[2] == 5 and p[3] == 5)");
  expect_good(
      "local p = cube(10):anchor('left+front bottom') assert(p[1] == 0 and p[2] == 0 and p[3] == "
      "0)");
  expect_good("local p = square(10):anchor('back') assert(#p == 2 and p[1] == 5 and p[2] == 10)");
  EXPECT_EQ(measure_of("cube(2):attach(cube(10), 'top')"), "4 4 10 .. 6 6 12 = 8");
  EXPECT_EQ(measure_of("cube(2):attach(cube(10), 'right', {gap = 1})"), "11 4 4 .. 13 6 6 = 8");
  EXPECT_EQ(measure_of("cube(2):attach(cube(10), 'top-left', 'bottom-left')"),
            "0 4 10 .. 2 6 12 = 8");
  EXPECT_EQ(measure_of("attach(cube(2), cube(10), 'bottom')"), "4 4 -2 .. 6 6 0 = 8");
  EXPECT_EQ(measure_of("cube(2):align{x = 'center', z = 'max'}"), "-1 0 -2 .. 1 2 0 = 8");
  EXPECT_EQ(measure_of("cube(2):align{y = 'max', to = cube(10)}"), "0 8 0 .. 2 10 2 = 8");
  EXPECT_EQ(measure_of("cube(2):align('min', 'center', 'max', {to = {1, 2, 3}})"),
            "1 1 1 .. 3 3 3 = 8");
  EXPECT_EQ(measure_of("cube(2):centered()"), "-1 -1 -1 .. 1 1 1 = 8");
  EXPECT_EQ(measure_of("cube(2):translate(5, 5, 5):centered{true, false, true}"),
            "-1 5 -1 .. 1 7 1 = 8");
}

TEST(Copies, StandWhereTheyShould) {
  EXPECT_EQ(measure_of("cube(2):mirror_copy()"), "-2 0 0 .. 2 2 2 = 16");
  EXPECT_EQ(measure_of("cube(2):translate(1, 0, 0):mirror_copy{0, 0, 1}"), "1 0 -2 .. 3 2 2 = 16");
  EXPECT_EQ(measure_of("cube(2):linear_array(4, {3, 0, 1})"), "0 0 0 .. 11 2 5 = 32");
  EXPECT_EQ(measure_of("cube(2):linear_array(3, {3, 0, 0}, {center = true})"),
            "-3 0 0 .. 5 2 2 = 24");
  EXPECT_EQ(measure_of("cube(2):grid_array({3, 2}, {4, 5})"), "0 0 0 .. 10 7 2 = 48");
  EXPECT_EQ(measure_of("cube(2):grid_array{{2, 2, 2}, 3, center = true}"),
            "-1.5 -1.5 -1.5 .. 3.5 3.5 3.5 = 64");
  EXPECT_EQ(measure_of("cube(2):translate(9, -1, 0):polar_array(4)"), "-11 -11 0 .. 11 11 2 = 32");
  EXPECT_EQ(measure_of("cube(2):translate(9, -1, 0):polar_array(3, 180)"),
            "-11 -1 0 .. 11 11 2 = 24");
  EXPECT_EQ(measure_of("cube(2):polar_array(2, {center = {5, 5}})"), "0 0 0 .. 10 10 2 = 16");
  EXPECT_EQ(measure_of("cube(2):translate(0, 9, -1):polar_array(4, {axis = {1, 0, 0}})"),
            "0 -11 -11 .. 2 11 11 = 32");
  EXPECT_EQ(measure_of("cube(2):translate(9, -1, 0):polar_array(4, {turn = false})"),
            "-11 -11 0 .. 11 11 2 = 32");
  EXPECT_EQ(measure_of("square(2):linear_array(3, {3, 0}):linear_extrude(1)"),
            "0 0 0 .. 8 2 1 = 12");
  expect_good(
      "local l = cube(2):linear_array(4, {3, 0, 0}, {list = true}) assert(#l == 4 and "
      "l[4]:bbox().min[1] == 9)");
}

TEST(Copies, Mistakes) {
  const std::pair<const char*, const char*> cases[] = {
      {"cube(1):anchor('tpo')",
       "anchor: option 'at': there is no side 'tpo' (did you mean 'top'?); sides are left, right, "
       "front, back, bottom, top, center, as in \"top-left\""},
      {"cube(1):anchor('left-right')", "anchor: option 'at': 'left-right' has opposite sides"},
      {"(cube(1) - cube(1)):anchor()", "anchor: there is nothing in it, so it has no place"},
      {"anchor(5)",
       "anchor: the first argument must be a solid or a shape, got 5; as a method it is called "
       "with "
       "a colon, part:anchor(...)"},
      {"cube(1):attach()", "attach: needs the part to attach it to"},
      {"cube(1):attach(5)", "attach: option 'to' must be a solid or a shape, got 5"},
      {"cube(1):attach(cube(1), {gpa = 1})", "attach: unknown option 'gpa' (did you mean 'gap'?)"},
      {"cube(1):align{x = 'centre'}",
       "align: option 'x' must be \"min\", \"center\" or \"max\", got \"centre\" (did you mean "
       "'center'?)"},
      {"cube(1):align{x = 'min', to = 5}", "align: option 'to' must be a point or a part, got 5"},
      {"cube(1):align{x = 'min', to = {1}}",
       "align: option 'to' must be a point or a part, got a list of one value"},
      {"cube(1):centered(5)",
       "centered: option 'axes' must be true, false or a list of three of them, got the number 5"},
      {"cube(1):linear_array(3)",
       "linear_array: needs how far it is from one to the next: {x, y, z}"},
      {"cube(1):linear_array()", "linear_array: needs how many"},
      {"cube(1):linear_array(0, {1, 0, 0})", "linear_array: option 'n' must be positive, got 0"},
      {"cube(1):linear_array(1e8, {1, 0, 0})",
       "linear_array: option 'n' must be at most 1000000, got 100000000"},
      {"cube(1):linear_array(2.5, {1, 0, 0})",
       "linear_array: option 'n' must be a whole number, got the number 2.5"},
      {"cube(1):grid_array({2, 0}, 1)",
       "grid_array: option 'n' must have whole numbers from 1 on, got 0"},
      {"cube(1):grid_array({1e6, 1e6}, 1)", "grid_array: makes more than 1000000 copies"},
      {"cube(1):grid_array({2, 2})",
       "grid_array: needs how many, {nx, ny}, and how far apart, {x, y}"},
      {"cube(1):polar_array(3, {axis = {0, 0, 0}})", "polar_array: option 'axis' must not be 0"},
      {"cube(1):polar_array(3, {agnle = 1})",
       "polar_array: unknown option 'agnle' (did you mean 'angle'?)"},
      {"cube(1):mirror_copy('x')",
       "mirror_copy: option 'v' must be a list of two or three numbers, got the string \"x\""},
  };
  for (const auto& [script, message] : cases)
    EXPECT_EQ(message_of(script), std::string("model.lua:1: ") + message);
}

TEST(Transforms, ShortForms) {
  EXPECT_EQ(box_of("cube(1):tx(1):ty(2):tz(3)"), "1 2 3 .. 2 3 4");
  EXPECT_EQ(box_of("cube(1):front(3)"), box_of("cube(1):forward(3)"));
  EXPECT_EQ(box_of("cube(1):up(1):down(2):left(3):right(5):back(7)"), "2 7 -1 .. 3 8 0");
  EXPECT_EQ(box_of("cube(1):rx(90):ry(90):rz(90)"), box_of("cube(1):rotate(90, 90, 90)"));
}

TEST(Transforms, AreValues) {
  expect_good(
      "local M = translate(1, 2, 3) * rotate(90) assert(M:inverse() * M == multmatrix{{1}})");
  expect_good(
      "local M = rotate(90):translate(1, 2, 3) assert(M == translate(1, 2, 3) * rotate(90))");
  expect_good(
      "assert(scale(2, 4, 8):inverse() == scale(0.5, 0.25, 0.125) and inverse{{2, 0, 0, 6}} == "
      "multmatrix{{0.5, 0, 0, -3}})");
  expect_good("local p = rotate(90):inverse() * {0, 1, 0} assert(p[1] == 1 and p[2] == 0)");
  expect_good(
      "local M = multmatrix{{1, 2, 3, 4}, {0, 1, 4, 5}, {5, 6, 0, 6}} local I = M:inverse() * M\n"
      "local p = I * {1, 2, 3} assert(abs(p[1] - 1) < 1e-12 and abs(p[2] - 2) < 1e-12 and abs(p[3] "
      "- 3) < 1e-12)");
  EXPECT_EQ(box_of("rotate(90):up(5) * cube(1)"), "-1 0 5 .. 0 1 6");
  EXPECT_EQ(message_of("multmatrix{{0}}:inverse()"),
            "model.lua:1: inverse: the matrix makes solids flat: nothing undoes it");
  EXPECT_EQ(message_of("inverse(cube(1))"), "model.lua:1: inverse: needs a matrix, got solid");
  EXPECT_EQ(message_of("return rotate(90):invrse()"),
            "model.lua:1: a matrix has no method 'invrse' (did you mean 'inverse'?)");
}

/// A folder with files, and scripts that are run in it.
class ReadingTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("csgrun_files_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  std::string run(const std::string& script) const {
    SessionOptions options = test_options();
    options.model = (folder_ / "model.lua").string();
    options.model_folder = folder_.string();
    Session session(options);
    const ScriptOutcome outcome = run_script(session, options.model, script + "\nemit(cube(1))");
    if (outcome.status == ScriptStatus::kGood) return "good";
    std::string message = outcome.message.substr(0, outcome.message.find('\n'));
    for (size_t at; (at = message.find(folder_.string() + "/")) != std::string::npos;)
      message.erase(at, folder_.string().size() + 1);
    return message;
  }
  std::filesystem::path folder_;
};

TEST_F(ReadingTest, Text) {
  write("a.txt", "one\ntwo");
  EXPECT_EQ(run("assert(read_text('a.txt') == 'one\\ntwo' and csg.read_text{file = 'a.txt'} == "
                "'one\\ntwo')"),
            "good");
  EXPECT_EQ(run("read_text('../x')").find("model.lua:1: read_text: '../x' lies outside"), 0u);
  EXPECT_EQ(run("read_text('b.txt')"),
            "model.lua:1: read_text: cannot read 'b.txt': No such file or directory");
  EXPECT_EQ(run("read_text()"), "model.lua:1: read_text: needs the name of a file");
  EXPECT_EQ(run("read_text(5)"),
            "model.lua:1: read_text: option 'file' must be a string, got the number 5");
}

TEST_F(ReadingTest, Json) {
  write(
      "a.json",
      R"({"n": 3, "x": 2.5, "list": [1, [2, "b"]], "on": true, "none": null, "deep": {"a": "ü"}})");
  EXPECT_EQ(run("local j = read_json('a.json')\n"
                "assert(j.n == 3 and math.type(j.n) == 'integer' and j.x == 2.5 and j.list[2][2] "
                "== 'b')\n"
                "assert(j.on == true and j.none == nil and j.deep.a == 'ü')"),
            "good");
  write("bad.json", "{\"a\": 1,\n \"b\" 2}");
  EXPECT_EQ(run("read_json('bad.json')"),
            "model.lua:1: read_json: bad.json:2: malformed JSON: syntax error while parsing object "
            "separator - unexpected number literal; expected ':'");
  write("null.json", "[1, null]");
  EXPECT_EQ(run("read_json('null.json')"),
            "model.lua:1: read_json: 'null.json': entry 2 of a list is null, which lists of Lua "
            "cannot have");
  write("deep.json", std::string(100000, '[') + std::string(100000, ']'));
  EXPECT_EQ(run("read_json('deep.json')"),
            "model.lua:1: read_json: tables are nested deeper than 200 times");
  write("huge.json", "[1e999]");
  EXPECT_EQ(run("read_json('huge.json')"),
            "model.lua:1: read_json: huge.json: a number is beyond the range of doubles");
}

TEST_F(ReadingTest, Csv) {
  write("a.csv", "x,y,name\n1,-2.5,hole\r\n3e2,4,\"a \"\"b\"\", c\nd\"\n\n");
  EXPECT_EQ(run("local t = read_csv('a.csv') assert(#t == 3 and t[1][1] == 'x' and t[2][2] == -2.5 "
                "and t[3][1] == 300)\n"
                "assert(t[3][3] == 'a \"b\", c\\nd')"),
            "good");
  EXPECT_EQ(run("local t = read_csv('a.csv', {header = true}) assert(#t == 2 and t[1].name == "
                "'hole' and t[2].y == 4)"),
            "good");
  EXPECT_EQ(run("assert(read_csv('a.csv', {numbers = false})[2][1] == '1')"), "good");
  write("huge.csv", "x,y\n1,1e999\n");
  EXPECT_EQ(run("read_csv('huge.csv')"),
            "model.lua:1: read_csv: huge.csv:2: 1e999 is beyond the range of doubles");
  write("twice.csv", "x,y,x\n1,2,3\n");
  EXPECT_EQ(run("read_csv('twice.csv', {header = true})"),
            "model.lua:1: read_csv: twice.csv:1: two columns have the name 'x'");
  write("b.csv", "1;0x10;nan;\"5\"");
  EXPECT_EQ(run("local r = read_csv('b.csv', {separator = ';'})[1] assert(r[1] == 1 and r[2] == "
                "'0x10' and r[3] == 'nan' and r[4] == '5')"),
            "good");
  write("c.csv", "a,b\n1,2\n3\n");
  EXPECT_EQ(run("read_csv('c.csv', {header = true})"),
            "model.lua:1: read_csv: c.csv:3: 1 fields under 2 names");
  write("d.csv", "1,2\n\"3,4\n");
  EXPECT_EQ(run("read_csv('d.csv')"), "model.lua:1: read_csv: d.csv:2: a quote is not closed");
  write("e.csv", "\"1\"2\n");
  EXPECT_EQ(run("read_csv('e.csv')"), "model.lua:1: read_csv: e.csv:1: text after a closing quote");
  EXPECT_EQ(run("read_csv('a.csv', {separator = ';;'})"),
            "model.lua:1: read_csv: option 'separator' must be one character");
  EXPECT_EQ(run("read_csv('a.csv', {headr = true})"),
            "model.lua:1: read_csv: unknown option 'headr' (did you mean 'header'?)");
}

TEST_F(ReadingTest, TreesOfOpenScad) {
  write("a.csg", "group() {\n\tcube(size = [2, 3, 4], center = false);\n}\n");
  write("flat.csg", "square(size = [2, 3], center = false);\n");
  write("bad.csg", "cube(size = [2, 3, 4], center = false);\nwhat(;\n");
  write("warn.csg",
        "cube(size = [2, 3, 4], center = false);\ncube(size = [0, 1, 1], center = false);\n");
  EXPECT_EQ(run("assert(csg.load_csg('a.csg'):volume() == 24)"), "good");
  EXPECT_EQ(run("assert(load_csg('flat.csg'):area() == 6)"), "good");
  EXPECT_EQ(run("load_csg('bad.csg')").find("model.lua:1: load_csg: bad.csg:2: "), 0u)
      << run("load_csg('bad.csg')");
  EXPECT_EQ(run("assert(load_csg('warn.csg'):volume() == 24)"), "good");
  EXPECT_EQ(run("load_csg('../a.csg')").find("model.lua:1: load_csg: '../a.csg' lies outside"), 0u);
}

}  // namespace
}  // namespace csgrun::testing::arrays_test
