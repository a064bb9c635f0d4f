// SPDX-License-Identifier: BSD-2-Clause
#include "render/ranks.h"

#include <utility>

#include "base/stopwatch.h"

namespace pbrtmedia {
namespace {

/// Has nobody to wait for, and all there is.
class OneRank final : public Ranks {
 public:
  std::size_t rank() const override { return 0; }
  std::size_t count() const override { return 1; }

 protected:
  void doWait() override {}
  void doBroadcast(std::string&) override {}
  void doAddUp(std::span<std::uint64_t>) override {}
  void doTakeLargest(std::span<float>) override {}
  std::vector<std::string> doExchange(std::span<const std::string>, std::span<const std::size_t>) override {
    return {};
  }
};

}  // namespace

template <class Move>
void Ranks::move(std::uint64_t bytes, std::uint64_t messages, const Move& move) {
  if (isAlone()) return;
  const Stopwatch waiting;
  doWait();
  traffic_.waiting += waiting.seconds();
  const Stopwatch moving;
  move();
  traffic_.moving += moving.seconds();
  traffic_.bytes += bytes;
  traffic_.messages += messages;
}

void Ranks::broadcast(std::string& bytes) {
  move(isFirst() ? bytes.size() : 0, 1, [&] { doBroadcast(bytes); });
}

void Ranks::addUp(std::span<std::uint64_t> numbers) {
  move(numbers.size_bytes(), 1, [&] { doAddUp(numbers); });
}

void Ranks::takeLargest(std::span<float> numbers) {
  move(numbers.size_bytes(), 1, [&] { doTakeLargest(numbers); });
}

std::vector<std::string> Ranks::exchange(std::span<const std::string> outgoing,
                                         std::span<const std::size_t> senders) {
  std::uint64_t bytes = 0, messages = 0;
  for (const std::string& text : outgoing) {
    bytes += text.size();
    messages += text.empty() ? 0 : 1;
  }
  std::vector<std::string> incoming;
  move(bytes, messages, [&] { incoming = doExchange(outgoing, senders); });
  return incoming;
}

std::vector<std::string> Ranks::gather(std::string bytes) {
  if (isAlone()) return {std::move(bytes)};
  std::vector<std::string> outgoing(count());
  if (!isFirst()) {
    outgoing.front() = std::move(bytes);
    return exchange(outgoing, {});
  }
  std::vector<std::size_t> senders;
  for (std::size_t r = 1; r < count(); ++r) senders.push_back(r);
  std::vector<std::string> all = exchange(outgoing, senders);
  all.insert(all.begin(), std::move(bytes));
  return all;
}

Ranks& oneRank() {
  static OneRank one;
  return one;
}

}  // namespace pbrtmedia
