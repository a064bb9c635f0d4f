// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <barrier>
#include <cstddef>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "render/ranks.h"

// Ranks that are threads of one process, each with a render of its own.
namespace pbrtmedia::test {

/// What they share.
struct ThreadRanksBoard {
  explicit ThreadRanksBoard(std::size_t count)
      : barrier(static_cast<std::ptrdiff_t>(count)), mail(count), sums(count), maxima(count) {}
  std::barrier<> barrier;
  std::string text;
  std::vector<std::vector<std::string>> mail;  ///< by senders
  std::vector<std::vector<std::uint64_t>> sums;
  std::vector<std::vector<float>> maxima;
};

class ThreadRanks final : public Ranks {
 public:
  ThreadRanks(ThreadRanksBoard& board, std::size_t rank) : board_(board), rank_(rank) {}
  std::size_t rank() const override { return rank_; }
  std::size_t count() const override { return board_.mail.size(); }

 protected:
  void doWait() override { board_.barrier.arrive_and_wait(); }
  void doBroadcast(std::string& bytes) override {
    if (rank_ == 0) board_.text = bytes;
    doWait();
    bytes = board_.text;
    doWait();
  }
  void doAddUp(std::span<std::uint64_t> numbers) override {
    combine(board_.sums, numbers, [](std::uint64_t a, std::uint64_t b) { return a + b; });
  }
  void doTakeLargest(std::span<float> numbers) override {
    combine(board_.maxima, numbers, [](float a, float b) { return std::max(a, b); });
  }
  std::vector<std::string> doExchange(std::span<const std::string> outgoing,
                                      std::span<const std::size_t> senders) override {
    board_.mail[rank_].assign(outgoing.begin(), outgoing.end());
    doWait();
    std::vector<std::string> incoming;
    for (const std::size_t from : senders) {
      incoming.push_back(board_.mail[from][rank_]);
      board_.mail[from][rank_].clear();
    }
    doWait();
    // Whoever sends what nobody expects has another idea of who takes what.
    for (const std::string& text : board_.mail[rank_]) isLost_ = isLost_ || !text.empty();
    return incoming;
  }

 public:
  /// A message was not expected by whom it was sent to.
  bool hasLost() const { return isLost_; }

 private:
  template <class T, class Join>
  void combine(std::vector<std::vector<T>>& all, std::span<T> numbers, const Join& join) {
    all[rank_].assign(numbers.begin(), numbers.end());
    doWait();
    for (std::size_t r = 0; r < all.size(); ++r) {
      for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = r == 0 ? all[0][i] : join(numbers[i], all[r][i]);
    }
    doWait();
  }

  ThreadRanksBoard& board_;
  std::size_t rank_;
  bool isLost_ = false;
};

/// Calls body(ranks) on so many ranks at the same time.
inline void onRanks(std::size_t count, const std::function<void(ThreadRanks&)>& body) {
  ThreadRanksBoard board(count);
  std::vector<std::thread> threads;
  for (std::size_t r = 0; r < count; ++r) {
    threads.emplace_back([&, r] {
      ThreadRanks ranks(board, r);
      body(ranks);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace pbrtmedia::test
