// What instrumented sources call (tests/mutate/instrument.py): operators that behave as written
// until their mutant is the active one. Exactly one mutant is active in a run, named by
// CSGRUN_MUTANT.
//
// `a < b` becomes `a <csgrun_mutant::Less<7>{}< b`: the tag has the precedence of the operator on
// either side, so nobody needs to know where the operands begin and end. In constant expressions
// everything is as written.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <type_traits>
#include <utility>

namespace csgrun_mutant {

constexpr int kMost = 1 << 14;

/// The active mutant; or, with CSGRUN_MUTANT_TRACE=FILE, which mutants' places were passed.
class State {
 public:
  State() {
    if (const char* number = std::getenv("CSGRUN_MUTANT")) flag_[std::atoi(number)] = kActive;
    trace_ = std::getenv("CSGRUN_MUTANT_TRACE");
    if (trace_) {
      for (auto& f : flag_) f = kUnseen;
    }
  }
  ~State() {
    std::FILE* file = trace_ ? std::fopen(trace_, "w") : nullptr;
    if (!file) return;
    for (int i = 0; i < kMost; ++i) {
      if (flag_[i] == kSeen) std::fprintf(file, "%d\n", i);
    }
    std::fclose(file);
  }
  bool active(int n) {
    const uint8_t f = flag_[n].load(std::memory_order_relaxed);
    if (f == kAsWritten) [[likely]] {
      return false;
    }
    if (f == kUnseen) flag_[n].store(kSeen, std::memory_order_relaxed);
    return f == kActive;
  }

 private:
  enum : uint8_t { kAsWritten, kActive, kUnseen, kSeen };
  std::atomic<uint8_t> flag_[kMost]{};  // no std::array: its checks would cost much here
  const char* trace_ = nullptr;
};
inline State state;

template <int N>
constexpr bool active() {
  if (std::is_constant_evaluated()) return false;
  return state.active(N);
}

/// The two operands of a tagged operator, the left one first.
template <class A, class Tag>
struct Left {
  A a;
};

// Comparisons: mutant N moves the border, mutant N + 1 turns the comparison round. At the end of a
// loop (Last): mutant N leaves out the last round.
#define CSGRUN_MUTANT_COMPARISON(NAME, OP, BORDER, TURNED)   \
  template <int N>                                           \
  struct NAME {};                                            \
  template <class A, int N>                                  \
  constexpr Left<A&&, NAME<N>> operator OP(A&& a, NAME<N>) { \
    return {std::forward<A>(a)};                             \
  }                                                          \
  template <class A, int N, class B>                         \
  constexpr bool operator OP(Left<A, NAME<N>> l, B&& b) {    \
    if (active<N>()) return l.a BORDER b;                    \
    if (active<N + 1>()) return l.a TURNED b;                \
    return l.a OP b;                                         \
  }
CSGRUN_MUTANT_COMPARISON(Less, <, <=, >)
CSGRUN_MUTANT_COMPARISON(Greater, >, >=, <)
CSGRUN_MUTANT_COMPARISON(LessEqual, <=, <, >=)
CSGRUN_MUTANT_COMPARISON(GreaterEqual, >=, >, <=)
#undef CSGRUN_MUTANT_COMPARISON

#define CSGRUN_MUTANT_PAIR(NAME, OP, RESULT, MUTATED)        \
  template <int N>                                           \
  struct NAME {};                                            \
  template <class A, int N>                                  \
  constexpr Left<A&&, NAME<N>> operator OP(A&& a, NAME<N>) { \
    return {std::forward<A>(a)};                             \
  }                                                          \
  template <class A, int N, class B>                         \
  constexpr RESULT operator OP(Left<A, NAME<N>> l, B&& b) {  \
    if constexpr (requires { MUTATED; }) {                   \
      if (active<N>()) return MUTATED;                       \
    }                                                        \
    return l.a OP b;                                         \
  }
template <class A>
constexpr A next(A a) {
  return ++a;
}
CSGRUN_MUTANT_PAIR(Equal, ==, bool, !(l.a == b))
CSGRUN_MUTANT_PAIR(Unequal, !=, bool, l.a == b)
CSGRUN_MUTANT_PAIR(LastLess, <, bool, l.a + 1 < b)
CSGRUN_MUTANT_PAIR(LastGreater, >, bool, l.a > b + 1)
CSGRUN_MUTANT_PAIR(LastLessEqual, <=, bool, l.a < b)
CSGRUN_MUTANT_PAIR(LastGreaterEqual, >=, bool, l.a > b)
CSGRUN_MUTANT_PAIR(LastUnequal, !=, bool, next(l.a) != b)
CSGRUN_MUTANT_PAIR(Plus, +, auto, l.a - b)
CSGRUN_MUTANT_PAIR(Minus, -, auto, l.a + b)
#undef CSGRUN_MUTANT_PAIR

// Prefix operators, as `tag ->* operand`, which binds tighter than any binary operator.
#define CSGRUN_MUTANT_PREFIX(NAME, OP, RESULT, MUTATED) \
  template <int N>                                      \
  struct NAME {};                                       \
  template <int N, class A>                             \
  constexpr RESULT operator->*(NAME<N>, A&& a) {        \
    if (active<N>()) return MUTATED;                    \
    return OP a;                                        \
  }
CSGRUN_MUTANT_PREFIX(Negative, -, auto, decltype(-a)(a))
CSGRUN_MUTANT_PREFIX(Not, !, bool, static_cast<bool>(a))
CSGRUN_MUTANT_PREFIX(Increment, ++, decltype(auto), --a)
CSGRUN_MUTANT_PREFIX(Decrement, --, decltype(auto), ++a)
#undef CSGRUN_MUTANT_PREFIX

// Assignments with an operation, as `a += tag += b`: they group from the right.
#define CSGRUN_MUTANT_UPDATE(NAME, OP, MUTATED)              \
  template <int N>                                           \
  struct NAME {};                                            \
  template <int N, class B>                                  \
  constexpr Left<B&&, NAME<N>> operator OP(NAME<N>, B&& b) { \
    return {std::forward<B>(b)};                             \
  }                                                          \
  template <class A, class B, int N>                         \
  constexpr A& operator OP(A& a, Left<B, NAME<N>> r) {       \
    if (active<N>()) {                                       \
      MUTATED;                                               \
    } else {                                                 \
      a OP std::forward<B>(r.a);                             \
    }                                                        \
    return a;                                                \
  }
CSGRUN_MUTANT_UPDATE(PlusUpdate, +=, a -= r.a)
CSGRUN_MUTANT_UPDATE(MinusUpdate, -=, a += r.a)
CSGRUN_MUTANT_UPDATE(OrUpdate, |=, static_cast<void>(r.a))
CSGRUN_MUTANT_UPDATE(AndUpdate, &=, static_cast<void>(r.a))
CSGRUN_MUTANT_UPDATE(XorUpdate, ^=, static_cast<void>(r.a))
#undef CSGRUN_MUTANT_UPDATE

/// std::min and std::max (MIN says which), and the other one as mutant N.
template <int N, bool MIN>
struct Extreme {
  template <class T>
  constexpr T operator()(std::initializer_list<T> list) const {
    return MIN != active<N>() ? std::min(list) : std::max(list);
  }
  template <class T>
  constexpr T operator()(const T& a, const T& b) const {
    return MIN != active<N>() ? std::min(a, b) : std::max(a, b);
  }
};

/// The value, or zero as mutant N.
template <int N, class T>
constexpr std::decay_t<T> or_zero(T&& value) {
  if (active<N>()) return std::decay_t<T>{};
  return std::forward<T>(value);
}

/// The side on which something lies (csgrun::Side, which is not known here). Mutants: N takes a
/// split for the front, N + 1 for the back, N + 2 exchanges front and back.
template <int N, class S>
S side(S s) {
  if (active<N>() && s == S::kSplit) return S::kFront;
  if (active<N + 1>() && s == S::kSplit) return S::kBack;
  if (active<N + 2>()) return s == S::kFront ? S::kBack : s == S::kBack ? S::kFront : s;
  return s;
}

}  // namespace csgrun_mutant
