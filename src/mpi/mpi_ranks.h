// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "render/ranks.h"

namespace pbrtmedia {

/// The processes that mpirun has started. One object in a process, which only the thread that made it may
/// use; MPI is left when it goes, and that waits for all. Errors of MPI itself end the job.
class MpiRanks final : public Ranks {
 public:
  /// As main has them; MPI may take out words of its own.
  MpiRanks(int& argc, char**& argv);
  ~MpiRanks() override;

  std::size_t rank() const override { return rank_; }
  std::size_t count() const override { return count_; }
  /// Name of this process's machine.
  static std::string host();
  /// Ends all processes, wherever they are; mpirun answers this status.
  [[noreturn]] static void abandon(int status);

 protected:
  void doWait() override;
  void doBroadcast(std::string& bytes) override;
  void doAddUp(std::span<std::uint64_t> numbers) override;
  void doTakeLargest(std::span<float> numbers) override;
  std::vector<std::string> doExchange(std::span<const std::string> outgoing,
                                      std::span<const std::size_t> senders) override;

 private:
  std::size_t rank_ = 0, count_ = 1;
};

}  // namespace pbrtmedia
