// Who runs the tasks of a parallel stage.
#pragma once

#include <memory>
#include <type_traits>

namespace thermedge {

// A reference to a callable `void(int)`, without allocation; valid during the call it is passed to.
class FunctionRef {
 public:
  template <class F>
  requires(!std::is_same_v<std::remove_cvref_t<F>, FunctionRef>)
      FunctionRef(F&& task)  // NOLINT(bugprone-forwarding-reference-overload)
      : object_(const_cast<void*>(static_cast<const void*>(&task))),
        call_([](void* object, int index) {
          (*static_cast<std::remove_reference_t<F>*>(object))(index);
        }) {}
  void operator()(int index) const { call_(object_, index); }

 private:
  void* object_;
  void (*call_)(void*, int);
};

// Runs `task(0) .. task(count - 1)`, each once, in any order, perhaps at the same time, and returns
// when all are done. Stages cut their work into tasks independently of the number of threads and
// merge results in task order; that is what makes the output the same for every ParallelRunner.
// One ParallelRunner serves one caller at a time.
class ParallelRunner {
 public:
  ParallelRunner() = default;
  ParallelRunner(const ParallelRunner&) = delete;
  ParallelRunner& operator=(const ParallelRunner&) = delete;
  virtual ~ParallelRunner() = default;

  virtual void run(int count, FunctionRef task) = 0;
  [[nodiscard]] virtual int threads() const = 0;
};

// A ParallelRunner on `threads` threads (the caller's is one of them); 0 takes one for each core.
// 1 runs the tasks in order on the caller's thread, and so does every number in a library that was
// built without oneTBB.
[[nodiscard]] std::unique_ptr<ParallelRunner> make_runner(int threads);

}  // namespace thermedge
