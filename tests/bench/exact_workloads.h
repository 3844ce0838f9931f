// Workloads that are experiments about exactness: each says in its counters what was proved, and
// ends with 1 where something does not hold.
#pragma once

#include <cstdint>
#include <string>

#include "tests/bench/run.h"

namespace csgrun::bench {

/// A mesh less a copy that is shifted as slightly as possible (Campen & Kobbelt 2010, chapter 7).
/// The mesh is scaled by a power of two so that its largest coordinate lies in [64, 128), and
/// snapped to 2^-20 mm; each vertex of the copy is moved in +x by one float32 unit in its last
/// place, at least one step. Proved: the difference is a manifold by index, and its volume is
/// exactly vol(A) - vol(A * B), modulo two primes.
void run_ulp(const std::string& name, const Settings& settings, const std::string& path);

/// A mesh through planes and local BSPs, everywhere, and back (chapter 7): the intersection with
/// itself by the kernel's literal path, in which every polygon is cut by the tree of its copy. On
/// the coarsest grid of decimals that holds the file's coordinates exactly, else scaled and snapped
/// as in run_ulp. Proved: the Hausdorff distance between the vertices of input and output is zero.
void run_round_trip(const std::string& name, const Settings& settings, const std::string& path);

/// All four operations of two meshes, each scaled to [-50, 50]^3 by its longest side, the second
/// one turned by a rotation drawn uniformly from `seed`. Proved: all are manifolds by index, and
/// the volumes are those of the inclusion-exclusion identities exactly, modulo two primes. Volume
/// and area of the line are the union's.
void run_pair(const std::string& name, const Settings& settings, const std::string& a,
              const std::string& b, uint64_t seed);

/// One operation of the same two, and nothing proved of it: for comparing times.
void run_pair_operation(const std::string& name, const Settings& settings, const std::string& a,
                        const std::string& b, uint64_t seed, BooleanOp op);

}  // namespace csgrun::bench
