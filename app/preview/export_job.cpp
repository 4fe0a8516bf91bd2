// SPDX-License-Identifier: BSD-3-Clause
// One thread, and what it shares with those who ask.
#include "app/preview/export_job.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

/// Ends an export that nobody wants any more.
struct ExportCancelled {};

}  // namespace

struct ExportJob::Shared {
  using Clock = std::chrono::steady_clock;

  const std::string path;
  std::mutex mutex{};  // guards all below
  std::condition_variable ended_now{};
  bool cancelled = false, ended = false;
  std::string stage{"begin"};
  double share = 0.0;
  nlohmann::json reply{};
  std::exception_ptr failure{};
  Clock::time_point begin = Clock::now(), end{};

  void watch(const char* at, double how_far) {
    const std::scoped_lock lock(mutex);
    if (cancelled) throw ExportCancelled();
    stage = at;
    share = how_far;
  }

  void finish(nlohmann::json made, std::exception_ptr thrown) {
    const std::scoped_lock lock(mutex);
    reply = std::move(made);
    failure = std::move(thrown);
    ended = true;
    end = Clock::now();
    ended_now.notify_all();
  }
};

ExportJob::ExportJob(std::string path, Work work) : shared_(new Shared{std::move(path)}) {
  thread_ = std::thread([shared = shared_, work = std::move(work)] {
    nlohmann::json reply;
    std::exception_ptr failure;
    try {
      reply = work([&shared](const char* stage, double share) { shared->watch(stage, share); });
    } catch (...) {
      failure = std::current_exception();
    }
    shared->finish(std::move(reply), std::move(failure));
  });
}

ExportJob::~ExportJob() {
  cancel();
  thread_.join();
}

void ExportJob::cancel() {
  const std::scoped_lock lock(shared_->mutex);
  shared_->cancelled = true;
}

bool ExportJob::running() const {
  const std::scoped_lock lock(shared_->mutex);
  return !shared_->ended;
}

nlohmann::json ExportJob::result() {
  std::unique_lock lock(shared_->mutex);
  shared_->ended_now.wait(lock, [&] { return shared_->ended; });
  if (!shared_->failure) return shared_->reply;
  try {
    std::rethrow_exception(shared_->failure);
  } catch (const ExportCancelled&) {
    throw RequestError(shared_->path + " was cancelled; nothing was written");
  } catch (const GpuError& error) {
    throw RequestError(std::string("export: ") + error.what());
  }
}

nlohmann::json ExportJob::told() {
  nlohmann::json told{{"path", shared_->path}};
  if (running()) {
    const std::scoped_lock lock(shared_->mutex);
    told.update({{"running", true}, {"stage", shared_->stage}, {"share", shared_->share}});
  } else {
    try {
      told.update(result());
    } catch (const Error& error) {
      told["error"] = escaped(error.what());
    } catch (const std::bad_alloc&) {
      told["error"] = "not enough memory";
    }
    told["running"] = false;
  }
  const auto end = told["running"].get<bool>() ? Shared::Clock::now() : shared_->end;
  told["seconds"] = std::chrono::duration<double>(end - shared_->begin).count();
  return told;
}

}  // namespace meniscus
