#include "camera/row_workers.h"

namespace onestroke {

RowWorkers::RowWorkers(int count) {
  for (int worker = 1; worker < count; ++worker) {
    Helper& helper = *helpers_.emplace_back(std::make_unique<Helper>());
    helper.thread = std::jthread([this, &helper, worker](const std::stop_token& stop) {
      for (;;) {
        helper.go.acquire();
        if (stop.stop_requested()) return;
        task_(context_, worker);
        helper.done.release();
      }
    });
  }
}

RowWorkers::~RowWorkers() {
  for (const auto& helper : helpers_) {
    helper->thread.request_stop();
    helper->go.release();
  }
  for (const auto& helper : helpers_) helper->thread.join();
}

void RowWorkers::run(Task task, void* context) {
  task_ = task;
  context_ = context;
  for (const auto& helper : helpers_) helper->go.release();
  task(context, 0);
  for (const auto& helper : helpers_) helper->done.acquire();
}

}  // namespace onestroke
