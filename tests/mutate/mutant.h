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
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <type_traits>
#include <utility>

namespace csgrun_mutant {

constexpr int kMost = 1 << 15;
enum : int { kTracing = -1, kAsWritten = kMost };

/// The active mutant; or, with CSGRUN_MUTANT_TRACE=FILE, which mutants would have made a
/// difference: a run is as written until its mutant's place has another outcome for the first time,
/// so a test in which that does not happen cannot notice the mutant.
class State {
 public:
  State() {
    if (const char* number = std::getenv("CSGRUN_MUTANT")) mutant = std::atoi(number);
    trace_ = std::getenv("CSGRUN_MUTANT_TRACE");
    if (trace_) mutant = kTracing;
  }
  ~State() {
    std::FILE* file = trace_ ? std::fopen(trace_, "w") : nullptr;
    if (!file) return;
    for (int i = 0; i < kMost; ++i) {
      if (seen_[i].load(std::memory_order_relaxed)) std::fprintf(file, "%d\n", i);
    }
    std::fclose(file);
  }
  void see(int n) {
    if (!seen_[n].load(std::memory_order_relaxed)) seen_[n].store(true, std::memory_order_relaxed);
  }
  int mutant = kAsWritten;

 private:
  std::atomic<bool> seen_[kMost]{};  // no std::array: its checks would cost much here
  const char* trace_ = nullptr;
};
inline State state;

/// Not to be kept in a constant: the initialiser of one may count as a constant expression.
constexpr int mutant() { return std::is_constant_evaluated() ? kAsWritten : state.mutant; }

/// Whether mutant N is active, where it is known to differ.
template <int N>
constexpr bool active() {
  if (mutant() == kTracing) state.see(N);
  return mutant() == N;
}

/// As told apart by anything that looks at them; things that cannot be compared are different.
template <class A>
constexpr bool same(const A& a, const A& b) {
  if constexpr (std::is_same_v<A, double>) {
    return std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b);
  } else if constexpr (requires { static_cast<bool>(a == b); }) {
    return static_cast<bool>(a == b);
  } else {
    return false;
  }
}

/// For tracing: mutant N makes `mutated` of what is `written`.
template <int N, class A>
constexpr void compare(const A& written, const A& mutated) {
  if (!same(written, mutated)) state.see(N);
}

/// The two operands of a tagged operator, the left one first.
template <class A, class Tag>
struct Left {
  A a;
};

// Comparisons, of vectors too, whose result is one: mutant N moves the border, mutant N + 1 turns the
// comparison round. At the end of a loop (Last): mutant N leaves out the last round.
#define CSGRUN_MUTANT_COMPARISON(NAME, OP, BORDER, TURNED)   \
  template <int N>                                           \
  struct NAME {};                                            \
  template <class A, int N>                                  \
  constexpr Left<A&&, NAME<N>> operator OP(A&& a, NAME<N>) { \
    return {std::forward<A>(a)};                             \
  }                                                          \
  template <class A, int N, class B>                         \
  constexpr auto operator OP(Left<A, NAME<N>> l, B&& b) {    \
    int m = mutant();                                        \
    if (m == N) return l.a BORDER b;                         \
    if (m == N + 1) return l.a TURNED b;                     \
    const auto written = l.a OP b;                           \
    if (m == kTracing) {                                     \
      compare<N>(written, l.a BORDER b);                     \
      compare<N + 1>(written, l.a TURNED b);                 \
    }                                                        \
    return written;                                          \
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
      int m = mutant();                                      \
      if (m == N) return MUTATED;                            \
      RESULT written = l.a OP b;                             \
      if (m == kTracing) {                                   \
        RESULT mutated = MUTATED;                            \
        compare<N>(written, mutated);                        \
      }                                                      \
      return written;                                        \
    } else {                                                 \
      return l.a OP b;                                       \
    }                                                        \
  }
/// Not `next`: for iterators that could be std::next as well, and there would be no mutant.
template <class A>
constexpr A one_on(A a) {
  return ++a;
}
/// a + b; where that has no meaning, as for two iterators, b - a.
template <class A, class B>
constexpr auto sum_or_reverse(const A& a, const B& b) requires requires {
  b - a;
} || requires {
  a + b;
}
{
  if constexpr (requires { a + b; }) {
    return a + b;
  } else {
    return b - a;
  }
}
CSGRUN_MUTANT_PAIR(Equal, ==, bool, !(l.a == b))
CSGRUN_MUTANT_PAIR(Unequal, !=, bool, l.a == b)
CSGRUN_MUTANT_PAIR(LastLess, <, bool, l.a + 1 < b)
CSGRUN_MUTANT_PAIR(LastGreater, >, bool, l.a > b + 1)
CSGRUN_MUTANT_PAIR(LastLessEqual, <=, bool, l.a < b)
CSGRUN_MUTANT_PAIR(LastGreaterEqual, >=, bool, l.a > b)
CSGRUN_MUTANT_PAIR(LastUnequal, !=, bool, l.a != b && one_on(l.a) != b)
CSGRUN_MUTANT_PAIR(Plus, +, auto, l.a - b)
CSGRUN_MUTANT_PAIR(Minus, -, auto, sum_or_reverse(l.a, b))
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
    int m = mutant();                                        \
    if (m == N) {                                            \
      MUTATED;                                               \
      return a;                                              \
    }                                                        \
    if (m == kTracing) {                                     \
      if constexpr (std::is_arithmetic_v<A>) {               \
        const A before = a;                                  \
        MUTATED;                                             \
        const A mutated = a;                                 \
        a = before;                                          \
        compare<N>(static_cast<A>(a OP r.a), mutated);       \
        return a;                                            \
      }                                                      \
      state.see(N);                                          \
    }                                                        \
    a OP std::forward<B>(r.a);                               \
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
    return of(std::min(list), std::max(list));
  }
  template <class T>
  constexpr T operator()(const T& a, const T& b) const {
    return of(std::min(a, b), std::max(a, b));
  }

 private:
  template <class T>
  static constexpr T of(const T& least, const T& most) {
    if (mutant() == kTracing) compare<N>(least, most);
    return MIN != (mutant() == N) ? least : most;
  }
};

/// A condition; mutant N takes it for VALUE whatever it is.
template <int N, bool VALUE>
constexpr bool fixed(bool condition) {
  if (mutant() == kTracing) compare<N>(condition, VALUE);
  return mutant() == N ? VALUE : condition;
}

/// A condition, and its reverse as mutant N.
template <int N>
constexpr bool turned(bool condition) {
  return condition != active<N>();
}

/// The value, or zero as mutant N.
template <int N, class T>
constexpr std::decay_t<T> or_zero(T&& value) {
  if (mutant() == N) return std::decay_t<T>{};
  if (mutant() == kTracing) compare<N>(std::decay_t<T>(value), std::decay_t<T>{});
  return std::forward<T>(value);
}

/// The side on which something lies (csgrun::Side, which is not known here). Mutants: N takes a
/// split for the front, N + 1 for the back, N + 2 exchanges front and back.
template <int N, class S>
S side(S s) {
  if (s == S::kSplit) return active<N>() ? S::kFront : active<N + 1>() ? S::kBack : s;
  if (s != S::kFront && s != S::kBack) return s;
  return active<N + 2>() == (s == S::kFront) ? S::kBack : S::kFront;
}

}  // namespace csgrun_mutant
