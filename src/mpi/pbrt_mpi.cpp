// SPDX-License-Identifier: BSD-2-Clause
// `pbrt-mpi`: pbrt on many machines. `mpirun -n 64 pbrt-mpi` with the options of pbrt renders the image of
// one process.
#include <glog/logging.h>

#include <chrono>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>

#include "main/options.h"
#include "main/render.h"
#include "main/together.h"
#include "mpi/message_pattern.h"
#include "mpi/mpi_ranks.h"

namespace pbrtmedia {
namespace {

/// A rank that fails on its own gives the first so much time to fail in the same way, and to tell it.
constexpr std::chrono::seconds kPatience{1};

/// While alive nothing that this process prints is seen: the first rank speaks for all.
class Silence {
 public:
  Silence() : out_(std::cout.rdbuf(said_.rdbuf())), err_(std::cerr.rdbuf(said_.rdbuf())) {}
  ~Silence() { end(); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
  /// What would have been printed.
  std::string end() {
    if (out_) std::cout.rdbuf(out_);
    if (err_) std::cerr.rdbuf(err_);
    out_ = err_ = nullptr;
    return said_.str();
  }

 private:
  std::ostringstream said_;
  std::streambuf *out_, *err_;
};

}  // namespace
}  // namespace pbrtmedia

int main(int argc, char** argv) {
  using namespace pbrtmedia;
  MpiRanks ranks(argc, argv);
  std::optional<Silence> silence;
  if (!ranks.isFirst()) silence.emplace();
  if (argc == 2 && std::string_view(argv[1]) == "--message-pattern") {
    std::cout << messagePattern();
    return 0;
  }
  const OptionsOutcome outcome = readOptions(argc, argv);
  if (!outcome.options) return outcome.exitStatus;
  google::InitGoogleLogging(argv[0]);
  Together together(ranks);
  const int status = runPbrtProgram(*outcome.options, together);
  if (!together.leavesAlone()) return status;
  // The others wait for this one.
  if (silence) {
    std::this_thread::sleep_for(kPatience);
    const std::string said = silence->end();
    std::cerr << "rank " << ranks.rank() << " on " << MpiRanks::host() << ": " << said;
  }
  MpiRanks::abandon(status);
}
