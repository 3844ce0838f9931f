// A reference to a function calls that very one, whatever it is.
#include "engine/base/function_ref.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace csgrun::function_ref_test {
namespace {

int twice(FunctionRef<int(int)> f, int x) { return f(f(x)); }

TEST(FunctionRef, CallsWhatItRefersTo) {
  int calls = 0;
  const auto add_three = [&calls](int x) { return ++calls, x + 3; };
  EXPECT_EQ(twice(add_three, 1), 7);
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(twice([](int x) { return 10 * x; }, 5), 500);
  EXPECT_EQ(twice(std::function<int(int)>([](int x) { return x - 1; }), 0), -2);
}

TEST(FunctionRef, KeepsTheStateOfTheFunctionNotACopyOfIt) {
  auto count = [n = 0]() mutable { return ++n; };
  const FunctionRef<int()> f = count;
  EXPECT_EQ(f(), 1);
  const FunctionRef<int()> copy = f;
  EXPECT_EQ(copy(), 2);
  EXPECT_EQ(count(), 3);
}

TEST(FunctionRef, PassesReferencesAndWhatCanOnlyBeMoved) {
  std::string text = "a";
  const auto append = [](std::string& to, std::unique_ptr<int> number) -> std::string& {
    return to += std::to_string(*number);
  };
  const FunctionRef<std::string&(std::string&, std::unique_ptr<int>)> f = append;
  EXPECT_EQ(&f(text, std::make_unique<int>(7)), &text);
  EXPECT_EQ(text, "a7");
}

}  // namespace
}  // namespace csgrun::function_ref_test
