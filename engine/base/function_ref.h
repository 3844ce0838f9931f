// A function that is called where its type is not known, for as long as a call lasts.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

namespace csgrun {

template <class Signature>
class FunctionRef;

/// Refers to something that can be called, which must outlive it. Nothing is copied or allocated.
template <class Return, class... Args>
class FunctionRef<Return(Args...)> {
 public:
  /// Implicit: a parameter takes any function.
  template <class F>
  // NOLINTNEXTLINE(bugprone-forwarding-reference-overload): the constraint leaves copies alone
  requires(!std::is_same_v<std::remove_cvref_t<F>, FunctionRef>) FunctionRef(F&& function)
      : object_(const_cast<void*>(static_cast<const void*>(std::addressof(function)))),
        call_([](void* object, Args... args) -> Return {
          return (*static_cast<std::remove_reference_t<F>*>(object))(std::forward<Args>(args)...);
        }) {}

  Return operator()(Args... args) const { return call_(object_, std::forward<Args>(args)...); }

 private:
  void* object_;
  Return (*call_)(void*, Args...);
};

}  // namespace csgrun
