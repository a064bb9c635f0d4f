// SPDX-License-Identifier: BSD-2-Clause
#include "mpi/mpi_ranks.h"

#include <mpi.h>

#include <algorithm>
#include <cstdlib>

namespace pbrtmedia {
namespace {

/// MPI counts in int: what is longer goes in pieces of this size, and one that is smaller ends it.
constexpr std::size_t kPiece = std::size_t{1} << 30;
constexpr int kTag = 1;

/// Calls move(first, count) for the pieces of something so long.
template <class Move>
void inPieces(std::size_t length, std::size_t piece, const Move& move) {
  for (std::size_t first = 0; first < length; first += piece)
    move(first, static_cast<int>(std::min(piece, length - first)));
}

/// What one rank has sent to this one.
std::string receive(int from) {
  std::string text;
  for (;;) {
    MPI_Message message = MPI_MESSAGE_NULL;
    MPI_Status status;
    MPI_Mprobe(from, kTag, MPI_COMM_WORLD, &message, &status);
    int bytes = 0;
    MPI_Get_count(&status, MPI_CHAR, &bytes);
    const std::size_t before = text.size();
    text.resize(before + static_cast<std::size_t>(bytes));
    MPI_Mrecv(text.data() + before, bytes, MPI_CHAR, &message, MPI_STATUS_IGNORE);
    if (static_cast<std::size_t>(bytes) < kPiece) return text;
  }
}

}  // namespace

MpiRanks::MpiRanks(int& argc, char**& argv) {
  int provided = MPI_THREAD_SINGLE, rank = 0, count = 1;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  rank_ = static_cast<std::size_t>(rank);
  count_ = static_cast<std::size_t>(count);
}

MpiRanks::~MpiRanks() { MPI_Finalize(); }

std::string MpiRanks::host() {
  char name[MPI_MAX_PROCESSOR_NAME + 1] = {};
  int length = 0;
  MPI_Get_processor_name(name, &length);
  return {name, static_cast<std::size_t>(length)};
}

void MpiRanks::abandon(int status) {
  MPI_Abort(MPI_COMM_WORLD, status);
  std::abort();
}

void MpiRanks::doWait() { MPI_Barrier(MPI_COMM_WORLD); }

void MpiRanks::doBroadcast(std::string& bytes) {
  std::uint64_t length = bytes.size();
  MPI_Bcast(&length, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  bytes.resize(static_cast<std::size_t>(length));
  inPieces(bytes.size(), kPiece, [&](std::size_t first, int count) {
    MPI_Bcast(bytes.data() + first, count, MPI_CHAR, 0, MPI_COMM_WORLD);
  });
}

void MpiRanks::doAddUp(std::span<std::uint64_t> numbers) {
  inPieces(numbers.size(), kPiece / sizeof(std::uint64_t), [&](std::size_t first, int count) {
    MPI_Allreduce(MPI_IN_PLACE, &numbers[first], count, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  });
}

void MpiRanks::doTakeLargest(std::span<float> numbers) {
  inPieces(numbers.size(), kPiece / sizeof(float), [&](std::size_t first, int count) {
    MPI_Allreduce(MPI_IN_PLACE, &numbers[first], count, MPI_FLOAT, MPI_MAX, MPI_COMM_WORLD);
  });
}

std::vector<std::string> MpiRanks::doExchange(std::span<const std::string> outgoing,
                                              std::span<const std::size_t> senders) {
  std::vector<MPI_Request> requests;
  const auto send = [&](std::size_t to, const char* bytes, int count) {
    requests.emplace_back();
    MPI_Isend(bytes, count, MPI_CHAR, static_cast<int>(to), kTag, MPI_COMM_WORLD, &requests.back());
  };
  for (std::size_t to = 0; to < outgoing.size(); ++to) {
    const std::string& text = outgoing[to];
    if (text.empty()) continue;
    inPieces(text.size(), kPiece,
             [&](std::size_t first, int count) { send(to, text.data() + first, count); });
    if (text.size() % kPiece == 0) send(to, text.data(), 0);
  }
  std::vector<std::string> incoming;
  for (const std::size_t from : senders) incoming.push_back(receive(static_cast<int>(from)));
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return incoming;
}

}  // namespace pbrtmedia
