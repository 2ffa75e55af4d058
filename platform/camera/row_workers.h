#pragma once

#include <memory>
#include <semaphore>
#include <thread>
#include <vector>

namespace onestroke {

/// A few threads that share the rows of one picture after another.
class RowWorkers {
 public:
  using Task = void (*)(void* context, int worker);

  /// count includes the thread that calls run().
  explicit RowWorkers(int count);
  ~RowWorkers();
  int count() const { return static_cast<int>(helpers_.size()) + 1; }
  /// Calls task once for each worker, 0 on this thread; returns when all are done. Tasks do not throw.
  void run(Task task, void* context);

 private:
  struct Helper {
    std::binary_semaphore go{0}, done{0};
    std::jthread thread;
  };

  Task task_ = nullptr;
  void* context_ = nullptr;
  std::vector<std::unique_ptr<Helper>> helpers_;
};

}  // namespace onestroke
