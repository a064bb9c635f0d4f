// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pbrtmedia {

/// What a rank gave to others and how long that took.
struct RankTraffic {
  std::uint64_t bytes = 0;     ///< sent to other ranks; of sums and maxima once what a rank puts in
  std::uint64_t messages = 0;  ///< sent to one other rank, and common operations
  double waiting = 0;          ///< seconds until the last rank had come to what they do in common
  double moving = 0;           ///< seconds of sending and receiving
};

/// The processes that render one image together. What is done in common is called by one thread of each
/// process, by all ranks in the same order: they wait for each other. A process that leaves before the end
/// must end the others too, which would wait for it for ever.
class Ranks {
 public:
  Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  virtual ~Ranks() = default;

  /// From 0.
  virtual std::size_t rank() const = 0;
  virtual std::size_t count() const = 0;
  /// The rank that decides and tells.
  bool isFirst() const { return rank() == 0; }
  bool isAlone() const { return count() == 1; }

  /// All get what the first has.
  void broadcast(std::string& bytes);
  /// All get the sums.
  void addUp(std::span<std::uint64_t> numbers);
  /// All get the largest of each; no number may be NaN.
  void takeLargest(std::span<float> numbers);
  /// Sends outgoing[r] to rank r; an empty text is no message. `senders`: the ranks of which a message comes,
  /// in rising order. Answers their texts, in this order.
  std::vector<std::string> exchange(std::span<const std::string> outgoing,
                                    std::span<const std::size_t> senders);
  /// The first gets what every rank has, in their order, its own too; others nothing. No text may be empty.
  std::vector<std::string> gather(std::string bytes);

  /// Of this rank so far.
  const RankTraffic& traffic() const { return traffic_; }

 protected:
  virtual void doWait() = 0;
  virtual void doBroadcast(std::string& bytes) = 0;
  virtual void doAddUp(std::span<std::uint64_t> numbers) = 0;
  virtual void doTakeLargest(std::span<float> numbers) = 0;
  virtual std::vector<std::string> doExchange(std::span<const std::string> outgoing,
                                              std::span<const std::size_t> senders) = 0;

 private:
  /// Waits for the others, then moves what is to be moved, and notes both.
  template <class Move>
  void move(std::uint64_t bytes, std::uint64_t messages, const Move& move);

  RankTraffic traffic_;
};

/// A render by one process.
Ranks& oneRank();

}  // namespace pbrtmedia
