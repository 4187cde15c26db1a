#pragma once
#include <exception>
#include <functional>

namespace lamella {

/// A computation was given up, as asked.
struct Cancelled : std::exception {
  const char* what() const noexcept override { return "cancelled"; }
};

/// While it lives, what this thread computes is given up where `wanted` says so: parallel loops ask
/// before every chunk, on any thread, and throw Cancelled. For what is built anew: an object that a
/// loop works on is not whole then.
class Cancellation {
public:
  explicit Cancellation(std::function<bool()> wanted);
  ~Cancellation();
  Cancellation(const Cancellation&) = delete;
  Cancellation& operator=(const Cancellation&) = delete;

private:
  std::function<bool()> wanted_;
  const std::function<bool()>* before_; ///< of the one around this
};

} // namespace lamella
