#!/usr/bin/env python3
"""The same script gives the same bytes: on any number of threads, wherever it lies and from any
folder, where the decimal point is a comma, with a cache or without.
"""
import os
import pathlib
import shutil

import support

MODELS = [support.MODELS / f"{name}.lua" for name in ("assembly", "crossing", "imported")]
ENDINGS = ("glb", "stl", "obj")


class Determinism(support.Case):

    def setUp(self):
        super().setUp()
        self.runs = 0

    def files(self, model, *arguments, **options):
        """The bytes of all files that a run writes, by their names."""
        self.runs += 1
        folder = self.folder / f"run{self.runs}"
        folder.mkdir()
        outputs = [word for ending in ENDINGS for word in ("-o", folder / f"model.{ending}")]
        self.csgrun(model, "-q", *outputs, *arguments, **options)
        files = {path.name: path.read_bytes() for path in sorted(folder.iterdir())}
        self.assertEqual(sorted(files), ["model.glb", "model.mtl", "model.obj", "model.stl"])
        return files

    def assert_same(self, expected, model, *arguments, **options):
        files = self.files(model, *arguments, **options)
        differ = [name for name in expected if files[name] != expected[name]]
        self.assertEqual(differ, [], f"{model.name} {arguments} {options}")

    def test_threads_do_not_matter(self):
        for model in MODELS:
            with self.subTest(model.stem):
                expected = self.files(model, "--threads", 1)
                for threads in (2, 7):
                    self.assert_same(expected, model, "--threads", threads)

    def test_the_working_folder_does_not_matter(self):
        for model in MODELS:
            with self.subTest(model.stem):
                expected = self.files(model)
                self.assert_same(expected, model, cwd="/")
                self.assert_same(expected, pathlib.Path(model.name), cwd=model.parent)
                self.assert_same(expected, pathlib.Path("..", model.parent.name, model.name),
                                 cwd=model.parent)
                elsewhere = self.folder / f"elsewhere-{model.stem}"
                shutil.copytree(model.parent, elsewhere)
                self.assert_same(expected, elsewhere / model.name)
        octahedron = support.MODELS / "octahedron.off"
        self.assert_same(self.files(octahedron), pathlib.Path(octahedron.name), cwd=support.MODELS)

    def test_locale_and_time_zone_do_not_matter(self):
        german = self.german_locale()
        for model in MODELS:
            with self.subTest(model.stem):
                expected = self.files(model, env={"LC_ALL": "C", "TZ": "UTC"})
                self.assert_same(expected, model, env={"TZ": "Pacific/Chatham"})
                self.assert_same(expected, model, env=german)

    def test_numbers_have_points_in_any_locale(self):
        model = self.folder / "model.lua"
        model.write_text("print(0.5, tostring(1.25), string.format('%.3f', 2.5))\n"
                         "return cube(tonumber('1.5'))\n", encoding="utf-8")
        done = self.csgrun(model, "--stats", "--grid", "0.001", env=self.german_locale())
        self.assertIn("0.5\t1.25\t2.500", done.stderr)
        self.assertIn("volume 3.375 mm^3", done.stderr)

    def test_the_cache_does_not_matter(self):
        for model in MODELS:
            with self.subTest(model.stem):
                expected = self.files(model, "--no-cache")
                cache = self.folder / f"cache-{model.stem}"
                self.assert_same(expected, model, "--cache-dir", cache)
                self.assert_same(expected, model, "--cache-dir", cache)
                self.assert_same(expected, model)

    def german_locale(self):
        """An environment whose decimal point is a comma, made for this test."""
        folder = self.folder / "locales"
        if not folder.is_dir():
            folder.mkdir()
            done = support.run("localedef", "-i", "de_DE", "-f", "UTF-8", folder / "de_DE.UTF-8")
            self.assertTrue((folder / "de_DE.UTF-8" / "LC_NUMERIC").is_file(),
                            f"the package locales is needed: {done.stderr}")
        environment = {"LC_ALL": "de_DE.UTF-8", "LANG": "de_DE.UTF-8", "LOCPATH": str(folder),
                       "TZ": "Europe/Berlin"}
        done = support.run("printf", "%.1f", "1,5", env=environment)
        self.assertEqual(done.stdout, "1,5", "the German locale is not in force")
        return environment


if __name__ == "__main__":
    os.environ.pop("LC_ALL", None)
    support.main()
