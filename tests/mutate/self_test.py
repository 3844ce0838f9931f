"""The mutation check checked: each kind of mutant is found in a sample, compiled, and makes the sample
give another answer; without a mutant it gives its own. And the kernel's sources can be read."""
import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import instrument
import mutate

SAMPLE = r"""
#include <algorithm>
#include <cassert>
#include <cstdio>
#include <iterator>
#include <limits>
#include <tuple>
#include <vector>

enum class Side { kFront, kBack, kOn, kSplit };

constexpr int twice(int a) { return a + a; }
static_assert(twice(2) == 4);

template <class T, int N>
struct Few {
  T value;
  Few operator-() const { return {-value}; }
  [[nodiscard]] bool small() const { return value < N; }
};

int number(Side s) {
  switch (s) {
    case Side::kFront: return 1;
    case Side::kBack: return 2;
    default: return 3;
  }
}

bool known(int v) {
  if (const int left = v / 6) return left != 1 || v == 7;
  if (const int rest = v % 3; rest == 1) return v > 4;
  return true;
}

int main() {
  constexpr int kFixed = 1 + 2;  // compile time: no mutant here
  assert(kFixed > 0);
  int sum = std::numeric_limits<unsigned>::min();
  std::vector<int> list{5, 3, 4};
  std::sort(list.begin(), list.end(), [](int a, int b) { return std::tie(a, b) < std::tie(b, a); });
  for (size_t i = 0; i < list.size(); ++i) sum += list[i] * static_cast<int>(i + 1);
  for (auto it = list.begin(); it != list.end(); ++it) {
    if (*it == 4) continue;
    sum = sum * 3 + *it;
  }
  bool odd = false, any = false;
  for (const int v : list) {
    odd ^= v % 2 != 0;
    any |= v >= 5;
  }
  int places = 0;
  for (int v = 0; v < 24; ++v) places = places * 2 + (known(v) ? 1 : 0);
  const bool turned = !odd && any;
  int down = 3;
  while (down > 1 && turned) --down;
  const int least = std::min(sum, 7) - std::max({1, 2, 3});
  const Few<int, 4> few{turned ? -3 : 4};
  std::printf("%d %d %d %d %d %d %d %d %d %d\n", sum, odd, any, turned, down, least, places,
              (-few).small() && few.small(), number(Side::kSplit), number(Side::kBack));
  for (int v = 2; v <= 4; ++v) std::printf("%d", twice(v));
  for (const Side s : {Side::kFront, Side::kBack, Side::kOn, Side::kSplit}) std::printf("%d", number(s));
}
"""
# What must be among the mutants, besides that most of them show.
EXPECTED = """
constexpr int twice(int a) { return a - a; }
Few operator-() const { return {value}; }
if (const int left = v / 6) return left == 1 || v == 7;
if (const int left = v / 6) return left != 1 || v != 7;
if (const int left = v / 6) return false || v == 7;
if (const int left = v / 6) return left != 1 || false;
if (const int rest = v % 3; false && (rest == 1)) return v > 4;
if (false && (const int left = v / 6)) return left != 1 || v == 7;
return false;
for (size_t i = 0; i <[last round left out] list.size(); ++i) sum += list[i] * static_cast<int>(i + 1);
for (size_t i = 0; i < list.size(); ++i) sum -= list[i] * static_cast<int>(i + 1);
for (auto it = list.begin(); it !=[last round left out] list.end(); ++it) {
if (*it == 4) ;
if (false && (*it == 4)) continue;
odd ^=[left out] v % 2 != 0;
any |= v > 5;
const bool turned = odd && any;
const bool turned = true && any;
while (down > 1 && turned) ++down;
while (down >= 1 && turned) --down;
const int least = std::max(sum, 7) - std::max({1, 2, 3});
const int least = std::min(sum, 7) + std::max({1, 2, 3});
const Few<int, 4> few{!(turned) ? -3 : 4};
const Few<int, 4> few{turned ? 3 : 4};
switch (s)[split taken for front] {
switch (s)[front and back exchanged] {
for (int v = 2; v < 4; ++v) std::printf("%d", twice(v));
""".strip().splitlines()
# Mutants of the sample that cannot show, or do not at these values: comparisons in which equal operands
# never occur, operands that decide nothing.
UNSEEN = 12
# Those among them whose places never have another outcome.
INDIFFERENT = """
[[nodiscard]] bool small() const { return value <= N; }
while (down > 1 && true) --down;
""".strip().splitlines()


def answer(program, **environment):
    try:
        run = subprocess.run([program], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=10,
                             env={**os.environ, **environment})
    except subprocess.TimeoutExpired:
        return "too long"
    return run.stdout if run.returncode == 0 else run.returncode


def check_resuming():
    """What was noticed is left out while its file is the same."""
    name = "engine/bsp/job.cpp"
    same, changed, new = (instrument.Mutant(name, 1, text) for text in ("a", "b", "c"))
    with tempfile.TemporaryDirectory() as folder:
        kept, mutate.NOTICED = mutate.NOTICED, Path(folder, "noticed")
        mutate.NOTICED.write_text(json.dumps([same.key, mutate.source_hash(name)]) + "\n" +
                                  json.dumps([changed.key, "another"]) + "\n")
        arguments = argparse.Namespace(only="", again=False, resume=True, explained=False, count=None)
        assert mutate.choose([same, changed, new], arguments, {}) == [changed, new]
        mutate.NOTICED = kept


def main():
    check_resuming()
    sample = instrument.Instrumenter("sample.cpp", SAMPLE, 0)
    text = sample.run()
    texts = {m.text for m in sample.mutants}
    missing = [e for e in EXPECTED if e not in texts]
    assert not missing, "no such mutants: " + "\n".join(missing)
    assert not any("kFixed" in t or "static_assert" in t for t in texts)
    with tempfile.TemporaryDirectory() as folder:
        source, program = Path(folder, "sample.cpp"), Path(folder, "sample")
        source.write_text(text)
        compiler = os.environ.get("CXX", "c++")
        flags = ["-std=c++20", "-DNDEBUG", "-D_GLIBCXX_ASSERTIONS", "-I", str(Path(__file__).parent)]
        subprocess.run([compiler, *flags, str(source), "-o", str(program)], check=True)
        plain = Path(folder, "plain.cpp")
        plain.write_text(SAMPLE)
        subprocess.run([compiler, *flags, str(plain), "-o", f"{program}0"], check=True)
        expected = answer(f"{program}0")
        assert answer(program) == expected, "differs without a mutant"
        unseen = [m for m in sample.mutants if answer(program, CSGRUN_MUTANT=str(m.number)) == expected]
        trace = Path(folder, "trace")
        assert answer(program, CSGRUN_MUTANT_TRACE=str(trace)) == expected
        different = {int(n) for n in trace.read_text().split()}
    changed = {m.number for m in sample.mutants} - {m.number for m in unseen}
    assert changed <= different, "a mutant shows that should make no difference"
    assert {m.text for m in unseen if m.number not in different} >= set(INDIFFERENT), "traced too much"
    for m in unseen:
        print(f"unseen: {m.text}")
    assert len(unseen) <= UNSEEN, f"{len(unseen)} mutants do not show"
    count = 0
    places = mutate.Places(kept={})
    for folder in mutate.MUTATED:
        for path in sorted((mutate.ROOT / folder).iterdir()):
            file = instrument.Instrumenter(f"{folder}/{path.name}", path.read_text(), count)
            file.run()
            places.first(file.name, len(file.mutants))  # ends the test where there is no room
            count += len(file.mutants)
    assert count > 60, "the kernel has hardly a place to break"
    print(f"{len(sample.mutants)} mutants of the sample, {count} of the kernel")
    return 0


if __name__ == "__main__":
    sys.exit(main())
