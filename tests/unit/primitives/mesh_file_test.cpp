#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csgrun/primitives/mesh_file.h>

#include "tests/support/source_folder.h"
#include "tests/unit/primitives/mesh_measures.h"

namespace csgrun::mesh_file_test {
namespace {

using testing::expect_closed;
using testing::volume;

const std::string kOff =
    "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
const std::string kObj =
    "# a tetrahedron\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

void append_float(std::string& out, float value, bool big = false) {
  auto bits = std::bit_cast<uint32_t>(value);
  for (int i = 0; i < 4; ++i) {
    out += static_cast<char>(bits >> (8 * (big ? 3 - i : i)) & 0xff);
  }
}

void append_u32(std::string& out, uint32_t value, bool big = false) {
  append_float(out, std::bit_cast<float>(value), big);
}

const float kPoints[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const uint32_t kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

std::string binary_stl() {
  std::string out(80, ' ');
  out.replace(0, 5, "solid");  // as some programs write it
  append_u32(out, 4);
  for (const auto& face : kFaces) {
    for (int i = 0; i < 3; ++i) append_float(out, 0);
    for (const uint32_t p : face) {
      for (const float c : kPoints[p]) append_float(out, c);
    }
    out += std::string(2, '\0');
  }
  return out;
}

std::string ascii_stl() {
  std::string out = "solid a tetrahedron, of facets\n";
  for (const auto& face : kFaces) {
    out += " facet normal 0 0 nan\n  outer loop\n";
    for (const uint32_t p : face) {
      out += "   vertex " + std::to_string(kPoints[p][0]) + " " + std::to_string(kPoints[p][1]) +
             " " + std::to_string(kPoints[p][2]) + "\r\n";
    }
    out += "  endloop\n endfacet\n";
  }
  return out + "endsolid\n";
}

std::string binary_ply(bool big) {
  std::string out = "ply\nformat binary_";
  out += big ? "big" : "little";
  out +=
      "_endian 1.0\ncomment made by hand\nelement vertex 4\nproperty uchar quality\n"
      "property float x\nproperty float y\nproperty float z\nproperty float nx\n"
      "element face 4\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
      "end_header\n";
  for (const auto& p : kPoints) {
    out += '\7';
    for (const float c : p) append_float(out, c, big);
    append_float(out, std::nanf(""), big);
  }
  for (const auto& face : kFaces) {
    out += '\3';
    for (const uint32_t i : face) append_u32(out, i, big);
    out += '\2';
    append_float(out, 0.5f, big);
    append_float(out, 0.25f, big);
  }
  return out;
}

const std::string kPlyHeader =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
    "property double z\nelement face 4\nproperty list uint8 int32 vertex_index\nend_header\n";
const std::string kPly =
    kPlyHeader + "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

std::string message(const std::string& name, std::string_view bytes) {
  const auto mesh = parse_mesh(name, bytes);
  return mesh ? "no error" : mesh.error().message;
}

void expect_tetrahedron(const std::string& name, std::string_view bytes) {
  const auto mesh = parse_mesh(name, bytes);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->points.size(), 4u) << name;
  EXPECT_EQ(mesh->face_count(), 4u);
  EXPECT_TRUE(mesh->keep_facets);
  EXPECT_EQ(mesh->kind, name);
  expect_closed(*mesh);
  EXPECT_NEAR(volume(*mesh), 1.0 / 6, 1e-15);
  std::string note;
  const auto solid = make_solid_mesh(*mesh, &note);
  EXPECT_TRUE(solid);
  EXPECT_EQ(note, "");
}

TEST(MeshFile, ReadsEveryFormat) {
  expect_tetrahedron("part.off", kOff);
  expect_tetrahedron("part.OBJ", kObj);
  expect_tetrahedron("part.stl", binary_stl());
  expect_tetrahedron("part.stl", ascii_stl());
  expect_tetrahedron("part.ply", kPly);
  expect_tetrahedron("part.ply", binary_ply(false));
  expect_tetrahedron("part.ply", binary_ply(true));
}

TEST(MeshFile, OffVariants) {
  expect_tetrahedron("a.off",
                     "OFF 4 4 0 # counts here\n\n# a comment\n0 0 0\n1 0 0 # one\n0 1 0\n0 0 1\n"
                     "3 0 2 1 255 0 0\n3 0 1 3\n\n3 0 3 2\n3  1 2 3");
  expect_tetrahedron("a.off",
                     "COFF\n4 4\n0 0 0 1 1 1 1\n1 0 0 0 0 0 1\n0 1 0 0 0 0 1\n0 0 1 0 0 0 1\n"
                     "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  EXPECT_EQ(message("a.off", "OFF BINARY\n"), "a.off:1: binary OFF is not supported");
  EXPECT_EQ(message("a.off", "nOFF\n3\n"),
            "a.off:1: OFF with points of other than three coordinates is not supported: \"nOFF\"");
}

TEST(MeshFile, ObjVariants) {
  expect_tetrahedron(
      "a.obj",
      "mtllib a.mtl\no thing\nvn 0 0 1\nvt 0 0\nv 0 0 0 1.0\nv +1 0e0 .0 0.5 0.5 0.5\n"
      "v 0 1. 0\nv 0 0 1\ng side\nusemtl red\ns off\nf -4/1/1 -2/1/1 -3/1/1\n"
      "f 1//1 2//1 \\\n 4//1\nf 1/1 4/1 3/1\nl 1 2\nf 2 3 4\n");
  // Faces before the points that they name.
  expect_tetrahedron("a.obj",
                     "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1");
  const auto quad = parse_mesh("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  ASSERT_TRUE(quad);
  EXPECT_EQ(quad->corners.size(), 4u);
}

TEST(MeshFile, WhatIsWrongIsSaidWithItsPlace) {
  EXPECT_EQ(message("a.obj", "v 0 0 0\nv 1 0 x\n"),
            "a.obj:2: expected a finite coordinate, got \"x\"");
  EXPECT_EQ(message("a.obj", "v 0 0 inf\n"), "a.obj:1: expected a finite coordinate, got \"inf\"");
  EXPECT_EQ(message("a.obj", "v 0 0 1e999\n"),
            "a.obj:1: expected a finite coordinate, got \"1e999\"");
  EXPECT_EQ(message("a.obj", "v 0 0 0\nf 1 1 2\nv 1 0 0\nf 1 2 3\n"),
            "a.obj:4: face index 3 is out of range, there are 2 points");
  EXPECT_EQ(message("a.obj", "v 0 0 0\nf -1 -2 -1\n"),
            "a.obj:2: face index -2 is out of range, there are 1 points");
  EXPECT_EQ(message("a.obj", "v 0 0 0\nf 1 0 1\n"), "a.obj:2: expected a face index, got \"0\"");
  EXPECT_EQ(message("a.obj", "v 0 0 0\nf 1 1\n"),
            "a.obj: has no faces; 1 face of fewer than three corners left out (first: line 2)");
  EXPECT_EQ(message("a.obj", "PNG\x01\x02"), "a.obj:1: not an OBJ statement: \"PNG\\x01\\x02\"");
  EXPECT_EQ(message("a.obj", "v 0 0 0\n"), "a.obj: has no faces");
  EXPECT_EQ(message("a.obj", ""), "a.obj: the file is empty");
  EXPECT_EQ(message("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
            "a.off:6: index 3 of face 0 is out of range, there are 3 points");
  EXPECT_EQ(message("a.off", "OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n"),
            "a.off:4: the line ends in point 1");
  EXPECT_EQ(message("a.off", "OFF\n2 1 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n"),
            "a.off:4: expected a finite number in point 1, got \"nan\"");
  EXPECT_EQ(message("a.off", kOff + "3 1 2 3\n"), "a.off:11: more data after the last face: \"3\"");
  EXPECT_EQ(message("a.stl", "hello"),
            "a.stl: byte 0: not an STL file: neither \"solid\" nor a header of 84 bytes");
  EXPECT_EQ(message("a.stl", binary_stl().substr(0, 200)),
            "a.stl: byte 80: not an STL file, or truncated: 4 triangles take 284 bytes, the file "
            "has 200");
  EXPECT_EQ(message("a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0\n"),
            "a.stl:6: the file ends where a finite number should be");
  EXPECT_EQ(
      message("a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 zero\n"),
      "a.stl:5: expected a finite number, got \"zero\"");
  std::string infinite = binary_stl();
  infinite.replace(84 + 12, 4, std::string("\0\0\x80\x7f", 4));
  EXPECT_EQ(message("a.stl", infinite),
            "a.stl: byte 96: triangle 0 has a coordinate that is not finite");
  EXPECT_EQ(message("a.ply", kOff), "a.ply:1: not a PLY file: it does not start with \"ply\"");
  EXPECT_EQ(
      message("a.ply",
              kPlyHeader + "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 4\n3 0 3 2\n3 1 2 3\n"),
      "a.ply: vertex index 4 is out of range, there are 4 points");
  EXPECT_EQ(
      message("a.ply",
              kPlyHeader + "0 0 0\n1 0 x\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"),
      "a.ply:11: vertex 1: not a finite number");
  for (const std::string length : {"1e+300", "-1", "2.5"}) {
    EXPECT_EQ(message("a.ply", kPlyHeader + "0 0 0\n1 0 0\n0 1 0\n0 0 1\n" + length + " 0 2 1\n"),
              "a.ply:14: a list has the length " + length);
  }
  EXPECT_EQ(message("a.txt", kOff),
            "a.txt: not a mesh file: its name must end in .stl, .off, .obj or .ply");
}

/// A PLY of a tetrahedron whose points are in two elements: one, and three.
std::string ply_of_two_elements(const std::string& first, const std::string& second,
                                const std::string& points) {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string rgb = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  return "ply\nformat ascii 1.0\nelement vertex 1\n" + xyz + (first.empty() ? "" : rgb) +
         "element vertex 3\n" + xyz + (second.empty() ? "" : rgb) +
         "element face 4\nproperty list uchar int vertex_index\nend_header\n" + points +
         "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
}

// A double holds less than other programs may write: what is too small is 0, what is too large an
// error, and which of them it is the digits and the exponent say together.
TEST(MeshFile, NumbersBeyondDoubles) {
  const std::string many(400, '0');
  const auto first = [](const std::string& number) -> std::optional<double> {
    const auto mesh =
        parse_mesh("a.off", "OFF\n3 1 0\n" + number + " 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    return mesh ? std::optional(mesh->points[0].x) : std::nullopt;
  };
  for (const std::string sign : {"", "-", "+"}) {
    for (const std::string& small : std::initializer_list<std::string>{
             "1e-400", "1E-400", "0." + many + "1", "0." + many + "1e+9",
             "1.5e-99999999999999999999", "12345e-500", "0." + many + "17E50", "1" + many + "e-800",
             "." + many + "1"}) {
      EXPECT_EQ(first(sign + small), 0) << sign << small;
    }
    for (const std::string& large : std::initializer_list<std::string>{
             "1e400", "1e+400", "1" + many + ".0", "1" + many + ".0e-9", "0.001e400",
             "12.5E999999999999999999999", "1" + many, "0." + many + "1e900"}) {
      EXPECT_FALSE(first(sign + large)) << sign << large;
    }
  }
  EXPECT_EQ(first("0." + many + "1e401"), 1);
  EXPECT_EQ(first("1" + many + "e-400"), 1);
}

TEST(MeshFile, ColoursOfPlyAreThoseOfTheirVertices) {
  // The last face has the last three points.
  const auto second = parse_mesh("a.ply", ply_of_two_elements("", "rgb",
                                                              "0 0 0\n1 0 0 255 0 0\n"
                                                              "0 1 0 255 0 0\n0 0 1 255 0 0\n"));
  ASSERT_TRUE(second) << second.error().message;
  EXPECT_EQ(second->appearance_of, (std::vector<uint32_t>{0, 0, 0, 1}));
  ASSERT_EQ(second->appearances.size(), 2u);
  EXPECT_EQ(second->appearances[1].red, 1);
  EXPECT_EQ(second->appearances[1].green, 0);
  const auto first =
      parse_mesh("a.ply", ply_of_two_elements("rgb", "", "0 0 0 255 0 0\n1 0 0\n0 1 0\n0 0 1\n"));
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_TRUE(first->appearance_of.empty());
}

TEST(MeshFile, ColoursOfPlyAreThoseOfTheirFaces) {
  const auto mesh =
      parse_mesh("a.ply",
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nelement face 1\nproperty list uchar int vertex_index\n"
                 "element face 1\nproperty list uchar int vertex_index\nproperty uchar red\n"
                 "property uchar green\nproperty uchar blue\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
                 "3 0 1 2\n3 0 2 1 0 0 255\n");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->appearance_of, (std::vector<uint32_t>{0, 1}));
}

TEST(MeshFile, ColoursAreNotMoreThanAModelHas) {
  std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 6561\nproperty list uchar int vertex_index\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
      "end_header\n0 0 0\n1 0 0\n0 1 0\n";
  for (int i = 0; i < 6561; ++i) {
    ply += "3 0 1 2";
    for (int k = 0, rest = i; k < 4; ++k, rest /= 9) ply += " " + std::to_string(rest % 9 * 31);
    ply += "\n";
  }
  std::vector<std::string> notes;
  const auto mesh = parse_mesh("a.ply", ply, nullptr, nullptr, &notes);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_LE(mesh->appearances.size(), 4097u);
  EXPECT_GE(mesh->appearances.size(), 1000u);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0], "a.ply: 6561 colours of faces were rounded to " +
                          std::to_string(mesh->appearances.size() - 1));
}

TEST(MeshFile, EveryTruncationIsAnErrorOrTheSameMesh) {
  const std::pair<const char*, std::string> files[] = {{"a.off", kOff},
                                                       {"a.obj", kObj},
                                                       {"a.stl", binary_stl()},
                                                       {"a.stl", ascii_stl()},
                                                       {"a.ply", kPly},
                                                       {"a.ply", binary_ply(false)},
                                                       {"a.ply", binary_ply(true)}};
  for (const auto& [name, bytes] : files) {
    for (size_t size = 0; size < bytes.size(); ++size) {
      const auto mesh = parse_mesh(name, std::string_view(bytes).substr(0, size));
      if (!mesh) {
        EXPECT_EQ(mesh.error().message.substr(0, 6), std::string(name) + ":");
      } else if (std::string_view(name) != "a.obj") {  // OBJ has no counts: it is shorter, and open
        EXPECT_EQ(mesh->face_count(), 4u) << name << ' ' << size;
      } else if (mesh->face_count() < 4) {
        EXPECT_FALSE(make_solid_mesh(*mesh, nullptr));
      }
    }
  }
}

TEST(MeshFile, DamagedBytesNeverCrash) {
  std::mt19937 random(6);
  const std::pair<const char*, std::string> files[] = {
      {"a.off", kOff},        {"a.obj", kObj}, {"a.stl", binary_stl()},
      {"a.stl", ascii_stl()}, {"a.ply", kPly}, {"a.ply", binary_ply(false)}};
  int errors = 0;
  for (const auto& [name, bytes] : files) {
    for (int round = 0; round < 3000; ++round) {
      std::string damaged = bytes;
      for (int k = 0; k < 3; ++k) damaged[random() % damaged.size()] = static_cast<char>(random());
      const auto mesh = parse_mesh(name, damaged);
      errors += mesh ? 0 : 1;
      if (!mesh) continue;
      for (const uint32_t corner : mesh->corners) ASSERT_LT(corner, mesh->points.size());
      (void)make_solid_mesh(*mesh, nullptr);
    }
  }
  EXPECT_GT(errors, 3000);
}

TEST(MeshFile, HugeCountsAreRefusedAtOnce) {
  std::string stl = binary_stl();
  std::string count;
  append_u32(count, 4000000000u);
  stl.replace(80, 4, count);
  stl[0] = 'x';
  const std::pair<const char*, std::string> files[] = {
      {"a.stl", stl},
      {"a.off", "OFF\n4000000000 1 0\n0 0 0\n"},
      {"a.off", "OFF\n3 4000000000 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n"},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
       "property float z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n0 0 "
       "0\n"},
      {"a.ply",
       "ply\nformat binary_little_endian 1.0\nelement vertex 0\nproperty float x\n"
       "property float y\nproperty float z\nelement face 1\n"
       "property list uint int vertex_index\nend_header\n\xff\xff\xff\xee"}};
  for (const auto& [name, bytes] : files) {
    const auto mesh = parse_mesh(name, bytes);
    ASSERT_FALSE(mesh) << name;
    EXPECT_EQ(mesh.error().code, ErrorCode::kLimit) << mesh.error().message;
  }
  EXPECT_EQ(message("a.off", "OFF\n4000000000 1 0\n0 0 0\n"),
            "a.off:2: 4000000000 points promised, but only 7 bytes follow");
}

TEST(MeshFile, OnlyRegularFilesAreRead) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("csgrun_mesh_" + std::to_string(::getpid()));
  fs::create_directories(folder / "dir.stl");
  ASSERT_EQ(::mkfifo((folder / "fifo.stl").c_str(), 0600), 0);
  std::ofstream(folder / "good.off") << kOff;
  auto error = [&](const std::string& path) {
    const auto mesh = read_mesh_file(path);
    return mesh ? std::string("no error") : mesh.error().message;
  };
  EXPECT_EQ(error(folder / "good.off"), "no error");
  EXPECT_EQ(error(folder / "dir.stl"),
            (folder / "dir.stl").string() + ": cannot read: it is a directory");
  EXPECT_EQ(error(folder / "fifo.stl"),
            (folder / "fifo.stl").string() + ": cannot read: it is a FIFO");
  EXPECT_EQ(error(folder / "none.stl"),
            (folder / "none.stl").string() + ": cannot read: No such file or directory");
  EXPECT_EQ(error("/dev/zero"), "/dev/zero: cannot read: it is a device");
  fs::remove_all(folder);
}

TEST(MakeSolidMesh, ReportsTurnsAndWelds) {
  std::string note;
  auto mesh = *parse_mesh("part.obj", kObj);
  mesh.corners.resize(9);
  mesh.loop_starts.resize(4);
  mesh.face_starts.resize(4);
  mesh.surface.resize(3);
  EXPECT_EQ(make_solid_mesh(mesh, &note).error().message.substr(0, 38),
            "part.obj: not closed: 3 open edges (fi");
  mesh = *parse_mesh("part.obj",
                     "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
  const auto turned = make_solid_mesh(mesh, &note);
  ASSERT_TRUE(turned);
  EXPECT_NEAR(volume(*turned), 1.0 / 6, 1e-15);
  EXPECT_EQ(note, "part.obj: inside out, its faces were turned over");
  mesh = *parse_mesh("part.obj",
                     "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  EXPECT_EQ(make_solid_mesh(mesh, &note).error().message.substr(0, 37),
            "part.obj: not consistently oriented: ");
  mesh = *parse_mesh("part.obj", kObj + "v 1 0 0\nf 2 5 3\n");
  const auto without = make_solid_mesh(mesh, &note);
  ASSERT_TRUE(without);
  EXPECT_EQ(without->face_count(), 4u);
  EXPECT_EQ(note, "part.obj: 1 face without area was dropped (at (1, 0, 0))");
  // Other faults are not mended by the way.
  mesh = *parse_mesh("part.obj", kObj + "v 1 0 0\nf 2 5 3\nv 2 2 2\nf 1 2 6\n");
  EXPECT_EQ(make_solid_mesh(mesh, &note).error().message.substr(0, 47),
            "part.obj: faces without area: 1 degenerate face");
}

TEST(MakeSolidMesh, RefusesListsThatDoNotFit) {
  auto mesh = *parse_mesh("part.obj", kObj);
  mesh.corners.resize(3);  // the loops go on
  EXPECT_EQ(make_solid_mesh(mesh, nullptr).error().message.substr(0, 33),
            "part.obj: indices out of range: 1");
}

TEST(MakeSolidMesh, SharedMeshes) {
  const auto folder = test::shared_folder() / "meshes";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no folder " << folder;
  for (const char* file :
       {"c3_nefertiti.obj", "lg_armadillo.obj", "lg_bunny.off", "lg_decimated-knight.off",
        "lg_elephant.obj", "lg_fandisk.off", "lg_fertility.off", "th_112932.stl", "th_1514499.stl",
        "th_472042.stl", "th_65004.stl"}) {
    const auto mesh = read_mesh_file(folder / file);
    ASSERT_TRUE(mesh) << mesh.error().message;
    std::string note;
    const auto solid = make_solid_mesh(*mesh, &note);
    ASSERT_TRUE(solid) << solid.error().message;
    expect_closed(*solid);
    EXPECT_GT(volume(*solid), 0);
    if (!note.empty()) std::printf("%s\n", note.c_str());
  }
}

}  // namespace
}  // namespace csgrun::mesh_file_test
