// SPDX-License-Identifier: BSD-2-Clause
#include "main/together.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/diagnostics.h"
#include "base/interruption.h"

namespace pbrtmedia {
namespace {

/// What was thrown, for the message of another process.
std::string textOf(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const SceneError& e) {
    const std::string where = e.location().toString();
    return (where.empty() ? "" : where + ": ") + e.what();
  } catch (const Interrupted& e) {
    return "stopped: " + e.reason();
  } catch (const std::bad_alloc&) {
    return "not enough memory";
  } catch (const std::exception& e) {
    return e.what();
  }
}

}  // namespace

void Together::tryTo(const std::function<void()>& part, std::exception_ptr& thrown) {
  try {
    part();
  } catch (...) {
    thrown = std::current_exception();
  }
}

void Together::agree(const std::exception_ptr& thrown) {
  std::vector<std::uint64_t> failed(ranks_.count());
  failed[ranks_.rank()] = thrown ? 1 : 0;
  ranks_.addUp(failed);
  std::size_t first = 0;
  while (first < failed.size() && failed[first] == 0) ++first;
  if (first == failed.size()) return;
  hasFailed_ = true;
  const std::vector<std::string> texts = ranks_.gather(thrown ? textOf(thrown) : "nothing");
  if (thrown) std::rethrow_exception(thrown);
  const std::string where = "rank " + std::to_string(first);
  throw std::runtime_error(texts.empty() ? where : where + ": " + texts[first]);
}

int Together::decide(int ofFirst) {
  if (ranks_.isAlone() || hasFailed_) return ofFirst;
  std::string text = std::to_string(ofFirst);
  ranks_.broadcast(text);
  return std::stoi(text);
}

Options optionsOfOthers(Options options) {
  options.quiet = true;
  options.verbose = options.png = false;
  options.progress = ProgressMode::None;
  options.statsFile.reset();
  options.displayServer.reset();
  options.serve.reset();
  if (options.timeLimit) *options.timeLimit += kLateness;  // passes tell it anew
  return options;
}

}  // namespace pbrtmedia
