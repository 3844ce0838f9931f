// A vector in chunks has what a vector has, and leaves it where it is.
#include "engine/base/chunked_vector.h"

#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace csgrun::chunked_vector_test {
namespace {

using Element = std::array<uint32_t, 3>;
using Chunked = ChunkedVector<Element>;

Element element(uint32_t i) { return {i, 7 * i, ~i}; }

TEST(ChunkedVector, HasWhatWasPutIn) {
  for (const size_t count : {size_t{0}, size_t{1}, Chunked::kChunk - 1, Chunked::kChunk,
                             Chunked::kChunk + 1, 3 * Chunked::kChunk, 5 * Chunked::kChunk - 7}) {
    Chunked chunked;
    std::vector<Element> plain;
    for (uint32_t i = 0; i < count; ++i) {
      chunked.push_back(element(i));
      plain.push_back(element(i));
      ASSERT_EQ(chunked.back(), plain.back());
    }
    ASSERT_EQ(chunked.size(), count);
    for (uint32_t i = 0; i < count; i += 3) chunked[i][1] = plain[i][1] = i + 1;
    for (size_t i = 0; i < count; ++i) ASSERT_EQ(chunked[i], plain[i]);
  }
}

TEST(ChunkedVector, TakesManyAtOnce) {
  Chunked chunked;
  std::vector<Element> plain;
  for (const size_t count : {size_t{5}, size_t{0}, Chunked::kChunk - 5, size_t{1},
                             2 * Chunked::kChunk, 3 * Chunked::kChunk + 7}) {
    std::vector<Element> more;
    for (uint32_t i = 0; i < count; ++i) more.push_back(element(i));
    chunked.append(more);
    plain.insert(plain.end(), more.begin(), more.end());
    chunked.append(count / 2, element(3));
    plain.insert(plain.end(), count / 2, element(3));
    ASSERT_EQ(chunked.size(), plain.size());
  }
  for (size_t i = 0; i < plain.size(); ++i) ASSERT_EQ(chunked[i], plain[i]);
}

TEST(ChunkedVector, TakesItsOwnElements) {
  Chunked chunked;
  chunked.push_back(element(5));
  while (chunked.size() < 3 * Chunked::kChunk) chunked.push_back(chunked[chunked.size() / 2]);
  for (size_t i = 0; i < chunked.size(); ++i) ASSERT_EQ(chunked[i], element(5));
}

TEST(ChunkedVector, LeavesElementsWhereTheyAre) {
  Chunked chunked;
  while (chunked.size() < Chunked::kChunk) chunked.push_back(element(1));
  std::vector<const Element*> places;
  for (uint32_t i = 0; i < 4 * Chunked::kChunk; ++i) {
    chunked.push_back(element(i));
    places.push_back(&chunked.back());
  }
  for (uint32_t i = 0; i < places.size(); ++i) {
    ASSERT_EQ(places[i], &chunked[Chunked::kChunk + i]);
    ASSERT_EQ(*places[i], element(i));
  }
}

TEST(ChunkedVector, LeavesElementsInSmallChunksFromTheStart) {
  ChunkedVector<Element, 8> chunked;
  for (int round = 0; round < 2; ++round) {
    std::vector<const Element*> places;
    for (uint32_t i = 0; i < 100; ++i) {
      chunked.push_back(element(i));
      places.push_back(&chunked.back());
    }
    for (uint32_t i = 0; i < 100; ++i) {
      ASSERT_EQ(places[i], &chunked[i]);
      ASSERT_EQ(*places[i], element(i));
    }
    chunked.clear();
    ASSERT_EQ(chunked.size(), 0u);
  }
}

// Filled again it has what was put in then, where it was before.
TEST(ChunkedVector, KeepsItsMemoryWhenCleared) {
  ChunkedVector<uint32_t, 8> chunked;
  std::vector<const uint32_t*> places;
  for (const uint32_t count : {40u, 3u, 0u, 8u, 9u, 40u, 128u, 70u}) {
    chunked.clear();
    EXPECT_EQ(chunked.size(), 0u);
    for (uint32_t i = 0; i < count; ++i) {
      chunked.push_back(count + i);
      EXPECT_EQ(chunked.back(), count + i);
      if (i == places.size()) places.push_back(&chunked.back());
      EXPECT_EQ(&chunked.back(), places[i]);
    }
    EXPECT_EQ(chunked.size(), count);
    for (uint32_t i = 0; i < count; ++i) EXPECT_EQ(chunked[i], count + i);
  }
}

}  // namespace
}  // namespace csgrun::chunked_vector_test
